; Without x, y, z >= 0 the inequality x^3 + y^3 + z^3 >= 3 x y z fails.
(set-logic QF_NRA)
(set-info :source |AM-GM, a hypothesis dropped|)
(set-info :status sat)
(declare-const x Real)
(declare-const y Real)
(declare-const z Real)
(assert (< (+ (* x x x) (* y y y) (* z z z)) (* 3 x y z)))
(check-sat)
