; An ellipse within a larger one of another shape.
(set-logic QF_NRA)
(set-info :source |own|)
(set-info :status unsat)
(declare-const x Real)
(declare-const y Real)
(assert (<= (+ (* x x) (* 2 (* y y))) 1))
(assert (>= (+ (* 3 (* x x)) (* x y) (* 3 (* y y))) 5))
(check-sat)
