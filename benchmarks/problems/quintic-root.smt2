; The real root of x^5 - x - 1, which has no expression by radicals.
(set-logic QF_NRA)
(set-info :source |classical|)
(set-info :status sat)
(declare-const x Real)
(assert (= (- (- (* x x x x x) x) 1) 0))
(check-sat)
