; The same claimed for all x >= -4, where it fails.
(set-logic QF_NRA)
(set-info :source |Bernoulli, mutated|)
(set-info :status sat)
(declare-const x Real)
(assert (>= x (- 4)))
(assert (< (* (+ 1 x) (+ 1 x) (+ 1 x) (+ 1 x) (+ 1 x)) (+ 1 (* 5 x))))
(check-sat)
