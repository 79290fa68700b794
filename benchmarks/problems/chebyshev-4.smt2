; |T_4| <= 1 on [-1, 1].
(set-logic QF_NRA)
(set-info :source |Chebyshev|)
(set-info :status unsat)
(declare-const x Real)
(assert (<= (- 1) x))
(assert (<= x 1))
(assert (or (> (+ (- (* 8 (* x x x x)) (* 8 (* x x))) 1) 1) (< (+ (- (* 8 (* x x x x)) (* 8 (* x x))) 1) (- 1))))
(check-sat)
