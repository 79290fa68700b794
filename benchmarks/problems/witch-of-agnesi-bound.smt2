; x/(1 + x^2) <= 1/2; the denominator never vanishes.
(set-logic QF_NRA)
(set-info :source |Agnesi's curve|)
(set-info :status unsat)
(declare-const x Real)
(assert (> (/ x (+ 1 (* x x))) (/ 1 2)))
(check-sat)
