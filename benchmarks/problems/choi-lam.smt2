; The form x^2 y^2 + y^2 z^2 + z^2 x^2 + w^4 - 4 x y z w at w = 1: nonnegative, no sum of squares.
(set-logic QF_NRA)
(set-info :source |Choi and Lam 1977|)
(set-info :status unsat)
(declare-const x Real)
(declare-const y Real)
(declare-const z Real)
(assert (< (- (+ (* (* x x) (* y y)) (* (* y y) (* z z)) (* (* z z) (* x x)) 1) (* 4 x y z)) 0))
(check-sat)
