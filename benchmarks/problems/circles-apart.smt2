; Two unit circles whose centres are 3 apart do not meet.
(set-logic QF_NRA)
(set-info :source |own|)
(set-info :status unsat)
(declare-const x Real)
(declare-const y Real)
(assert (= (+ (* x x) (* y y)) 1))
(assert (= (+ (* (- x 3) (- x 3)) (* y y)) 1))
(check-sat)
