; With 401/100 in place of 4 it is negative near (1, 1, 1).
(set-logic QF_NRA)
(set-info :source |Choi and Lam, mutated|)
(set-info :status sat)
(declare-const x Real)
(declare-const y Real)
(declare-const z Real)
(assert (< (- (+ (* (* x x) (* y y)) (* (* y y) (* z z)) (* (* z z) (* x x)) 1) (* (/ 401 100) x y z)) 0))
(check-sat)
