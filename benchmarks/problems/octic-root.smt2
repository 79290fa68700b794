; x^8 - x^5 + x^2 - 2 x + 1 has one: the root is no fraction.
(set-logic QF_NRA)
(set-info :source |own|)
(set-info :status sat)
(declare-const x Real)
(assert (= (+ (- (+ (- (* x x x x x x x x) (* x x x x x)) (* x x)) (* 2 x)) 1) 0))
(check-sat)
