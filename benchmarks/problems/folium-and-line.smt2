; The folium x^3 + y^3 = 3 x y meets the line y = 2 x - 1 away from (1, 1).
(set-logic QF_NRA)
(set-info :source |Descartes|)
(set-info :status sat)
(declare-const x Real)
(declare-const y Real)
(assert (= (+ (* x x x) (* y y y)) (* 3 x y)))
(assert (= y (- (* 2 x) 1)))
(check-sat)
