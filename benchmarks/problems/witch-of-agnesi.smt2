; x/(1 + x^2) exceeds 499/1000, which needs x near 1; the denominator never vanishes.
(set-logic QF_NRA)
(set-info :source |Agnesi's curve|)
(set-info :status sat)
(declare-const x Real)
(assert (> (/ x (+ 1 (* x x))) (/ 499 1000)))
(assert (not (= x 1)))
(check-sat)
