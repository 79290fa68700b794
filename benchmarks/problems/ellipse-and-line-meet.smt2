; x + 2 y = 2828/1000 < sqrt(8) is met, though only just.
(set-logic QF_NRA)
(set-info :source |own|)
(set-info :status sat)
(declare-const x Real)
(declare-const y Real)
(assert (<= (+ (* x x) (* 4 (* y y))) 4))
(assert (>= (+ x (* 2 y)) (/ 2828 1000)))
(check-sat)
