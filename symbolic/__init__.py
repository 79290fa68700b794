"""What the paper defines and derives (sections 2.2 to 4.4, appendices A and B), derived again from
first principles.

Newton's equation, momentum balance, restitution and the launch of the table are put in; everything
else is worked out on demand, and kept.  In reading order:

    algebra        symbols, states, linear systems, signs for all 0 < alpha < 1
    mechanics      flight, impact, the table, when ball and table meet
    maps           the return maps f1 and f2, their powers and fixed points
    energy         energy and its change; the normal form, in which only alpha is left
    bounds         E_max, Delta E_max, Delta E_sup; the region R and the times to enter it
    modes          the ways in which such a corner can slide or stick
    corner_impact  a corner that strikes a table with friction
    sine_table     a table that moves as a sine: bounces of one period, multipliers, curves
    lazy           names that load their file when first used

Importing this package loads nothing: a name loads the file that derives it when first used.

>>> from juggleproof.symbolic import f1, total_energy
>>> f1().T
Matrix([[(-alpha*beta*g + 2*alpha*r**2 - 2*alpha*r*v)/g, alpha*r - alpha*v - r]])
>>> total_energy()
beta*g + v**2/2
"""

from __future__ import annotations

from juggleproof.lazy import lazy_names

NAMES = {
    ".algebra": (
        "alpha beta v rho u r g t tau K n x w z1 z2 E0 DerivationError State affine_parts "
        "apply eigenvalues_of integral_from_zero lowest_terms root_of solution_of state "
        "unipotent_power reduced sign_for_lossy_impacts simplest_roots"
    ),
    ".mechanics": (
        "acceleration flight_map flight_matrix flight_offset fly hang_time collide impact_map "
        "mass_ratio restitution_matrix speeds_after_impact table_after_impact landing_state "
        "launch_state period state_after_ground table_at ball_speed_at_collision "
        "boundary_height boundary_speed collision_margin collision_time gap "
        "relative_state_at_collision table_speed_at_collision time_after_collision"
    ),
    ".maps": (
        "ball_after_collision controlled_step f1 f1_parts f2 f2_parts flight_power "
        "folded_impact impact_power_matrix return_eigenvalues return_jacobian return_map "
        "time_shift xi_1 collision_time_at_fixed_point e_1 epsilon_1 equilibrium_speed "
        "fixed_point impact_fixed_point relative_map restitution_threshold "
        "subharmonic_ball_speed subharmonic_bound subharmonic_table_speed "
        "table_speed_at_fixed_point"
    ),
    ".energy": (
        "energy_at energy_change_1 energy_change_2 energy_change_at_impact energy_gradient "
        "energy_in_flight relative_kinetic_energy relative_kinetic_energy_change total_energy "
        "zero_change_height zero_change_speed normal_collision_time normal_e_1 normal_e_2 "
        "normal_energy normal_energy_change normal_f1 normal_f2 normal_fixed_point "
        "normal_margin normal_flight_power normal_impact_fixed_point scaled scaled_state "
        "scaling unscaling normal_impact_after normal_periodic_impact "
        "normal_sum_of_heights normal_change_beside normal_impact_beside"
    ),
    ".bounds": (
        "Candidate candidates falls_without_bound greatest E_max Extremum delta_E_max "
        "delta_E_sup largest_energy_change largest_kept_energy least_energy_loss "
        "physical_state region_energy energy_of_p impacts_to_enter_region lagrange_multiplier "
        "point_p region_corner region_gradient region_margin "
        "stationary_speed_on_region_boundary time_to_enter_region worst_flight_time"
    ),
    ".modes": "MODES",
    ".corner_impact": (
        "B1 B2 B3 C0 J P_x P_y S0 c_x c_y contact_coefficients corner_velocity "
        "kinetic_energy_gained motion_after_impulse omega velocity_after_impulse "
        "work_of_impulse x_c y_c closing_rate compressing_impulse contact_impulse e "
        "energy_gained_in_contact mu newton_impulse normal_impulse sigma slides_back "
        "slides_through_compression slides_through_restitution stopping_impulse stopping_rate "
        "tangential_impulse velocity_after_contact"
    ),
    ".sine_table": (
        "G Gamma birth_drive bounce bounce_characteristic bounce_closing_speed "
        "bounce_determinant bounce_jacobian bounce_trace change_over_a_period cosine cosine_t "
        "doubling_fall half_turn impact_closing_speed multiplier other_bounce_gap "
        "other_bounce_jacobian sine sine_t squared_drive strike"
    ),
}
__all__, __getattr__, __dir__ = lazy_names(__name__, NAMES)
