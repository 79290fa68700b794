; The hyperbola x y = 1 does not enter the disc of radius 7/5.
(set-logic QF_NRA)
(set-info :source |own|)
(set-info :status unsat)
(declare-const x Real)
(declare-const y Real)
(assert (= (* x y) 1))
(assert (<= (+ (* x x) (* y y)) (/ 49 25)))
(check-sat)
