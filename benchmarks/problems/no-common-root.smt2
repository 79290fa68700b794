; x^2 - 2 and x^2 - 3 x + 1 have no common root.
(set-logic QF_NRA)
(set-info :source |resultant|)
(set-info :status unsat)
(declare-const x Real)
(assert (= (* x x) 2))
(assert (= (+ (- (* x x) (* 3 x)) 1) 0))
(check-sat)
