; With 301/100 in place of 3 it is negative near (1, 1).
(set-logic QF_NRA)
(set-info :source |Motzkin, mutated|)
(set-info :status sat)
(declare-const x Real)
(declare-const y Real)
(assert (< (- (+ (* (* x x x x) (* y y)) (* (* x x) (* y y y y)) 1) (* (/ 301 100) (* x x) (* y y))) 0))
(check-sat)
