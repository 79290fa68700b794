; (1 + x)^5 >= 1 + 5 x for x >= -1.
(set-logic QF_NRA)
(set-info :source |Bernoulli|)
(set-info :status unsat)
(declare-const x Real)
(assert (>= x (- 1)))
(assert (< (* (+ 1 x) (+ 1 x) (+ 1 x) (+ 1 x) (+ 1 x)) (+ 1 (* 5 x))))
(check-sat)
