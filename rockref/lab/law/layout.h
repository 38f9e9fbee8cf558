// Written by `python -m rockref.lab.layout`. Where each number stands in the flat arrays.
#pragma once
enum { C_X = 0, C_V = 3, C_L = 6, C_W = 15, C_A = 18, C_T = 21, C_GIVEN = 24, C_TIME = 25, C_ORIGIN = 26, C_COUNT = 27, C_Q = 28, C_Q_RATE = 29, C_PITCH = 30, C_PITCH_RATE = 31, C_STATE = 32 }; // state
enum { C_MASS = 0, C_GRAVITY = 1, C_J = 2, C_J_INVERSE = 11, C_PRINCIPAL = 20, C_BODY = 21 }; // body
enum { C_K_N = 0, C_K_T = 1, C_C_N = 2, C_C_T = 3, C_MU_0 = 4, C_MU = 5, C_RADIUS = 6, C_FOOT = 7, C_PROPS = 8 }; // points
enum { C_S_X = 0, C_S_Y = 1, C_ANCHORED = 2, C_SLIDING = 3, C_XI_LARGEST = 4, C_YAW = 5, C_ROLL_X = 6, C_ROLL_Y = 7, C_MEMORY = 8 }; // memory
enum { S_HERTZ = 0, S_HYSTERESIS = 3, S_HUNT = 6, S_ORIENTATION = 8, S_STRIBECK = 10, S_LOAD = 13, S_ADHESION = 16, S_VISCOUS = 19, S_NORMALS = 21, S_SPIN = 31, S_ROLLING = 34, S_DRAG = 36, S_CABLE = 39, S_WIRE = 46, S_VIBRATION = 51, S_TILT = 59, S_SUPPORT = 62, S_SLOTS = 70, S_CONTACT = 1, S_FORCES = 2, S_MOMENTS = 4, S_LOADS = 8, S_PLATE = 16 }; // effects
enum { M_mass, M_width, M_depth, M_height, M_g, M_foot_radius, M_points, M_K_N, M_K_T, M_beta_int, M_beta_ext, M_mu_int, M_mu_ext, M_delta_long_1, M_delta_long_2, M_delta_long_3, M_delta_long_4, M_delta_diag, M_theta_0, M_inertia_0, M_inertia_1, M_inertia_2, M_inertia_3, M_inertia_4, M_inertia_5, M_inertia_6, M_inertia_7, M_inertia_8, M_COUNT }; // model
enum { E_foot_defects_on = 0, E_foot_defects_delta_long1 = 1, E_foot_defects_delta_long2 = 2, E_foot_defects_delta_long3 = 3, E_foot_defects_delta_long4 = 4, E_foot_defects_delta_diag = 5, E_foot_defects_mu_int = 6, E_foot_defects_beta_int = 7 };
enum { E_dimension_deviation_on = 8, E_dimension_deviation_width = 9, E_dimension_deviation_depth = 10, E_dimension_deviation_height = 11, E_dimension_deviation_inertia_share = 12 };
enum { E_rounded_feet_on = 13, E_rounded_feet_radius = 14, E_rounded_feet_foot1 = 15, E_rounded_feet_foot2 = 16, E_rounded_feet_foot3 = 17, E_rounded_feet_foot4 = 18 };
enum { E_mass_eccentricity_on = 19, E_mass_eccentricity_x = 20, E_mass_eccentricity_y = 21, E_mass_eccentricity_z = 22 };
enum { E_inertia_deviation_on = 23, E_inertia_deviation_xx = 24, E_inertia_deviation_yy = 25, E_inertia_deviation_zz = 26, E_inertia_deviation_xy = 27, E_inertia_deviation_xz = 28, E_inertia_deviation_yz = 29 };
enum { E_uneven_foot_stiffness_on = 30, E_uneven_foot_stiffness_foot1 = 31, E_uneven_foot_stiffness_foot2 = 32, E_uneven_foot_stiffness_foot3 = 33, E_uneven_foot_stiffness_foot4 = 34, E_uneven_foot_stiffness_tangential_share = 35 };
enum { E_uneven_foot_damping_on = 36, E_uneven_foot_damping_foot1 = 37, E_uneven_foot_damping_foot2 = 38, E_uneven_foot_damping_foot3 = 39, E_uneven_foot_damping_foot4 = 40, E_uneven_foot_damping_normal_share = 41 };
enum { E_uneven_foot_friction_on = 42, E_uneven_foot_friction_foot1 = 43, E_uneven_foot_friction_foot2 = 44, E_uneven_foot_friction_foot3 = 45, E_uneven_foot_friction_foot4 = 46 };
enum { E_hertzian_contact_on = 47, E_hertzian_contact_exponent = 48, E_hertzian_contact_reference = 49 };
enum { E_hysteretic_contact_on = 50, E_hysteretic_contact_kappa = 51, E_hysteretic_contact_curved_share = 52 };
enum { E_hunt_crossley_contact_on = 53, E_hunt_crossley_contact_a = 54 };
enum { E_stribeck_friction_on = 55, E_stribeck_friction_ratio = 56, E_stribeck_friction_velocity = 57 };
enum { E_load_dependent_friction_on = 58, E_load_dependent_friction_exponent = 59, E_load_dependent_friction_reference = 60 };
enum { E_adhesion_on = 61, E_adhesion_force = 62, E_adhesion_range = 63 };
enum { E_viscous_friction_on = 64, E_viscous_friction_c = 65 };
enum { E_uneven_contact_normals_on = 66, E_uneven_contact_normals_x1 = 67, E_uneven_contact_normals_y1 = 68, E_uneven_contact_normals_x2 = 69, E_uneven_contact_normals_y2 = 70, E_uneven_contact_normals_x3 = 71, E_uneven_contact_normals_y3 = 72, E_uneven_contact_normals_x4 = 73, E_uneven_contact_normals_y4 = 74, E_uneven_contact_normals_turning_share = 75 };
enum { E_spin_friction_on = 76, E_spin_friction_radius = 77, E_spin_friction_sliding_share = 78 };
enum { E_rolling_resistance_on = 79, E_rolling_resistance_lever = 80 };
enum { E_quadratic_drag_on = 81, E_quadratic_drag_c = 82, E_quadratic_drag_c_v = 83 };
enum { E_cable_restraint_on = 84, E_cable_restraint_k = 85, E_cable_restraint_c = 86, E_cable_restraint_height = 87, E_cable_restraint_stiffening = 88, E_cable_restraint_reference = 89 };
enum { E_lingering_wire_pull_on = 90, E_lingering_wire_pull_force = 91, E_lingering_wire_pull_tau = 92, E_lingering_wire_pull_evenness = 93 };
enum { E_base_vibration_on = 94, E_base_vibration_amplitude = 95, E_base_vibration_frequency = 96, E_base_vibration_direction = 97, E_base_vibration_phase = 98, E_base_vibration_harmonic_cosine = 99, E_base_vibration_harmonic_sine = 100 };
enum { E_plate_tilt_on = 101, E_plate_tilt_x = 102, E_plate_tilt_y = 103 };
enum { E_compliant_support_on = 104, E_compliant_support_mass = 105, E_compliant_support_frequency = 106, E_compliant_support_ratio = 107, E_compliant_support_pitch = 108 };
enum { E_release_velocity_on = 109, E_release_velocity_x = 110, E_release_velocity_y = 111, E_release_velocity_z = 112 };
enum { E_gyro_misalignment_on = 113, E_gyro_misalignment_x = 114, E_gyro_misalignment_y = 115, E_gyro_misalignment_z = 116, E_gyro_misalignment_xy = 117, E_gyro_misalignment_xz = 118, E_gyro_misalignment_yz = 119 };
enum { E_gyro_scale_on = 120, E_gyro_scale_x = 121, E_gyro_scale_y = 122, E_gyro_scale_z = 123 };
enum { E_gyro_bandwidth_on = 124, E_gyro_bandwidth_frequency = 125, E_gyro_bandwidth_damping = 126, E_gyro_bandwidth_delay = 127 };
enum { E_gyro_drift_on = 128, E_gyro_drift_bias_x = 129, E_gyro_drift_bias_y = 130, E_gyro_drift_bias_z = 131, E_gyro_drift_rate_x = 132, E_gyro_drift_rate_y = 133, E_gyro_drift_rate_z = 134 };
enum { E_gyro_saturation_on = 135, E_gyro_saturation_range = 136, E_gyro_saturation_softness = 137 };
enum { E_clock_error_on = 138, E_clock_error_rate = 139 };
enum { E_COUNT = 140 };
