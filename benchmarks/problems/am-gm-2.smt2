; The arithmetic mean of two reals is at least the geometric mean: (x + y)^2 >= 4 x y.
(set-logic QF_NRA)
(set-info :source |AM-GM|)
(set-info :status unsat)
(declare-const x Real)
(declare-const y Real)
(assert (< (* (+ x y) (+ x y)) (* 4 x y)))
(check-sat)
