; The line x + 2 y = 3 passes the ellipse x^2 + 4 y^2 = 4: its largest x + 2 y is sqrt(8).
(set-logic QF_NRA)
(set-info :source |own|)
(set-info :status unsat)
(declare-const x Real)
(declare-const y Real)
(assert (<= (+ (* x x) (* 4 (* y y))) 4))
(assert (>= (+ x (* 2 y)) 3))
(check-sat)
