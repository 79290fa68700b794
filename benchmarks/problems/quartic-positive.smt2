; A quartic in two variables, a sum of squares that is not seen at sight.
(set-logic QF_NRA)
(set-info :source |own|)
(set-info :status unsat)
(declare-const x Real)
(declare-const y Real)
(assert (< (+ (- (+ (* 2 (* x x x x)) (* 2 (* x x x) y)) (* (* x x) (* y y))) (* 5 (* y y y y))) 0))
(check-sat)
