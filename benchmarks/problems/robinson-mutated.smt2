; Robinson's form at z = 1, less 1/100.
(set-logic QF_NRA)
(set-info :source |Robinson, mutated|)
(set-info :status sat)
(declare-const x Real)
(declare-const y Real)
(assert (< (+ (- (- (- (- (- (- (+ (* x x x x x x) (* y y y y y y) 1) (* (* x x x x) (* y y))) (* x x x x)) (* (* x x) (* y y y y))) (* y y y y)) (* x x)) (* y y)) (* 3 (* x x) (* y y))) (/ 1 100)))
(assert (> (* x y) (/ 1 2)))
(check-sat)
