; |x + y| <= |x| + |y|, the absolute value by ite.
(set-logic QF_NRA)
(set-info :source |own|)
(set-info :status unsat)
(declare-const x Real)
(declare-const y Real)
(define-fun abs1 ((t Real)) Real (ite (>= t 0) t (- t)))
(assert (> (abs1 (+ x y)) (+ (abs1 x) (abs1 y))))
(check-sat)
