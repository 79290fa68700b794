; Two unit circles whose centres are 1 apart meet, at an irrational height.
(set-logic QF_NRA)
(set-info :source |own|)
(set-info :status sat)
(declare-const x Real)
(declare-const y Real)
(assert (= (+ (* x x) (* y y)) 1))
(assert (= (+ (* (- x 1) (- x 1)) (* y y)) 1))
(check-sat)
