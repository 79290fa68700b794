; The same with 6 x^2 y^2 taken off: it takes both signs.
(set-logic QF_NRA)
(set-info :source |own|)
(set-info :status sat)
(declare-const x Real)
(declare-const y Real)
(assert (< (+ (- (+ (* 2 (* x x x x)) (* 2 (* x x x) y)) (* 7 (* x x) (* y y))) (* 5 (* y y y y))) 0))
(check-sat)
