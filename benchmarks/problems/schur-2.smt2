; Schur's inequality of degree 4, which holds for all reals.
(set-logic QF_NRA)
(set-info :source |Schur|)
(set-info :status unsat)
(declare-const x Real)
(declare-const y Real)
(declare-const z Real)
(assert (< (+ (* (* x x) (- x y) (- x z)) (* (* y y) (- y x) (- y z)) (* (* z z) (- z x) (- z y))) 0))
(check-sat)
