; V = x^2 + y^2 - x y falls along the reversed Van der Pol oscillator x' = -y, y' = x - (1 - x^2) y on |x|, |y|
; <= 1/2, but at 0.
(set-logic QF_NRA)
(set-info :source |own|)
(set-info :status unsat)
(declare-const x Real)
(declare-const y Real)
(assert (<= (/ (- 1) 2) x (/ 1 2)))
(assert (<= (/ (- 1) 2) y (/ 1 2)))
(assert (or (not (= x 0)) (not (= y 0))))
(assert (>= (+ (* (- (* 2 x) y) (- y)) (* (- (* 2 y) x) (- x (* (- 1 (* x x)) y)))) 0))
(check-sat)
