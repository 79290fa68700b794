; x^8 - x^5 + x^2 - x + 1 has no real root.
(set-logic QF_NRA)
(set-info :source |classical exercise|)
(set-info :status unsat)
(declare-const x Real)
(assert (<= (+ (- (+ (- (* x x x x x x x x) (* x x x x x)) (* x x)) x) 1) 0))
(check-sat)
