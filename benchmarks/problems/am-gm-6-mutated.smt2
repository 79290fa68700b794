; With 61/20 in place of 3 the inequality fails.
(set-logic QF_NRA)
(set-info :source |AM-GM, mutated|)
(set-info :status sat)
(declare-const x Real)
(declare-const y Real)
(assert (< (+ (* x x x x x x) (* y y y y y y) 1) (* (/ 61 20) (* x x) (* y y))))
(check-sat)
