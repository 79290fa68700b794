(* Sharp ranges of the checker of certificates, for any statements.

   Defined:  sharp (the rule), holds_for (what a statement says for some values of the parameters).
   Proved:   sharp_sound   on the domain the condition holds exactly where all the statements do, and the premises of each hold somewhere in it;
             number_sound (Coefficients.v): the polynomial of a `number` line has exactly one root between its ends. *)

From Coq Require Import Reals List Bool.
From Juggleproof Require Import Polynomials Formulas States Instances Leaves Values Settling.
Import ListNotations.

Definition with_lines (l : list line) (s : statement) : statement :=
  {| whole_numbers := whole_numbers s; lines := l ++ lines s; exist := exist s; goals := goals s |}.

(* A statement without its range lines; nodes and a proof that show it inside; a point. *)
Record entry := { stated : statement; steps : list node; inside : proof; possible : found }.

Definition sharp (known : list statement) (over whole_over : list nat) (domain condition : formula) (entries : list entry)
    (width : nat) (outside : found) : bool :=
  uses (member over) domain && uses (member over) condition && forallb (below width) over
  && forallb (fun e => prove known (with_lines [Given domain; Given condition] (stated e)) (steps e) (inside e)
                       && meets_premises known (with_lines [Given domain] (stated e)) (possible e)) entries
  && find known width (finish_values known over true (map (fun e => with_lines [Given domain] (stated e)) entries)) outside
       (assume (negate condition) (assume domain (no_facts whole_over))).

(* The parameters have their values in a; every other variable of the statement is its own. *)
Definition holds_for (over : list nat) (s : statement) (a : assignment) : Prop :=
  forall b, (forall i, In i over -> b i = a i) -> all_whole (whole_numbers s) b -> meaning (lines s) (reached s) b.

Theorem sharp_sound known over whole_over domain condition entries width outside : Forall valid known ->
  sharp known over whole_over domain condition entries width outside = true ->
  (forall a, all_whole whole_over a -> holds a domain -> (holds a condition <-> Forall (fun e => holds_for over (stated e) a) entries))
  /\ Forall (fun e => exists a, all_whole (whole_numbers (stated e)) a /\ holds a domain /\ Forall (holds a) (premises (lines (stated e)))) entries.
Proof.
  unfold sharp. intros truths good. apply andb_prop in good. destruct good as [good out]. apply andb_prop in good. destruct good as [good each].
  apply andb_prop in good. destruct good as [good low]. apply andb_prop in good. destruct good as [of_domain of_condition].
  rewrite forallb_forall in each. split.
  - intros a integer in_domain. split.
    + intro true_. apply Forall_forall. intros e here b same integer_b. specialize (each e here). apply andb_prop in each. destruct each as [proof_ _].
      pose proof (prove_sound _ _ _ _ truths proof_ b integer_b) as means. cbn [with_lines lines app meaning] in means.
      assert (agree : forall i, member over i = true -> a i = b i) by (intros i is_over; apply member_holds in is_over; symmetry; now apply same).
      apply means; [exact (proj1 (uses_holds _ a b domain of_domain agree) in_domain)|exact (proj1 (uses_holds _ a b condition of_condition agree) true_)].
    + intro all. destruct (holds_or_not a condition) as [yes|no]; [exact yes|exfalso]. apply negate_holds in no.
      destruct (values_sound known over width true _ outside _ truths low out a) as (s & b & here & same & integer_b & premises_ & fails_).
      { apply assume_point; [|exact no]. apply assume_point; [now apply no_facts_point|exact in_domain]. }
      apply in_map_iff in here. destruct here as (e & <- & here). rewrite Forall_forall in all. cbn [with_lines lines premises flat_map app] in premises_.
      apply (fails_ eq_refl). apply (goal_of_meaning _ (lines (stated e)) b); [exact (all e here b same integer_b)|]. now inversion premises_.
  - apply Forall_forall. intros e here. specialize (each e here). apply andb_prop in each. destruct each as [_ point_].
    destruct (point_sound _ _ _ truths point_) as (a & integer & all). exists a. cbn [with_lines lines premises flat_map app] in all.
    inversion all; subst. now repeat split.
Qed.
