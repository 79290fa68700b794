; The hyperbola x y = 1 meets the circle of radius sqrt(3).
(set-logic QF_NRA)
(set-info :source |own|)
(set-info :status sat)
(declare-const x Real)
(declare-const y Real)
(assert (= (* x y) 1))
(assert (= (+ (* x x) (* y y)) 3))
(check-sat)
