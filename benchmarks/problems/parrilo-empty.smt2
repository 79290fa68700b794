; {x - y^2 + 3 >= 0, y + x^2 + 2 = 0} is empty.
(set-logic QF_NRA)
(set-info :source |Parrilo 2000|)
(set-info :status unsat)
(declare-const x Real)
(declare-const y Real)
(assert (>= (+ (- x (* y y)) 3) 0))
(assert (= (+ y (* x x) 2) 0))
(check-sat)
