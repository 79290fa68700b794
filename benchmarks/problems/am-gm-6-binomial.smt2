; x^6 + y^6 + 1 >= 3 x^2 y^2.
(set-logic QF_NRA)
(set-info :source |AM-GM|)
(set-info :status unsat)
(declare-const x Real)
(declare-const y Real)
(assert (< (+ (* x x x x x x) (* y y y y y y) 1) (* 3 (* x x) (* y y))))
(check-sat)
