; Motzkin's polynomial is nonnegative and not a sum of squares.
(set-logic QF_NRA)
(set-info :source |Motzkin 1967|)
(set-info :status unsat)
(declare-const x Real)
(declare-const y Real)
(assert (< (- (+ (* (* x x x x) (* y y)) (* (* x x) (* y y y y)) 1) (* 3 (* x x) (* y y))) 0))
(check-sat)
