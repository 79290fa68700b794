; T_4 exceeds 1 just outside of [-1, 1].
(set-logic QF_NRA)
(set-info :source |Chebyshev, mutated|)
(set-info :status sat)
(declare-const x Real)
(assert (<= x (/ 101 100)))
(assert (>= x (- 1)))
(assert (> (+ (- (* 8 (* x x x x)) (* 8 (* x x))) 1) 1))
(check-sat)
