; Robinson's form at z = 1: nonnegative, no sum of squares.
(set-logic QF_NRA)
(set-info :source |Robinson 1969|)
(set-info :status unsat)
(declare-const x Real)
(declare-const y Real)
(assert (< (+ (- (- (- (- (- (- (+ (* x x x x x x) (* y y y y y y) 1) (* (* x x x x) (* y y))) (* x x x x)) (* (* x x) (* y y y y))) (* y y y y)) (* x x)) (* y y)) (* 3 (* x x) (* y y))) 0))
(check-sat)
