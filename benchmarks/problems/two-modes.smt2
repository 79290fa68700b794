; Of two modes (a Bool) exactly one applies, and the state after the step is the one before: a fixed point of a
; switched map.
(set-logic QF_NRA)
(set-info :source |own|)
(set-info :status sat)
(declare-const x Real)
(declare-const m Bool)
(assert (= x (ite m (- 1 (* 2 x x)) (+ (/ x 2) 1))))
(assert (xor m (> x 1)))
(assert (not (= x (- 1))))
(check-sat)
