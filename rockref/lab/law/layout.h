// Written by `python -m rockref.lab.layout`. Where each number stands in the flat arrays.
#pragma once
enum { C_X = 0, C_V = 3, C_L = 6, C_W = 15, C_A = 18, C_T = 21, C_GIVEN = 24, C_TIME = 25, C_ORIGIN = 26, C_COUNT = 27, C_Q = 28, C_Q_RATE = 29, C_PITCH = 30, C_PITCH_RATE = 31, C_STATE = 32 }; // state
enum { C_MASS = 0, C_GRAVITY = 1, C_J = 2, C_J_INVERSE = 11, C_PRINCIPAL = 20, C_BODY = 21 }; // body
enum { C_K_N = 0, C_K_T = 1, C_C_N = 2, C_C_T = 3, C_MU_0 = 4, C_MU = 5, C_RADIUS = 6, C_FOOT = 7, C_PROPS = 8 }; // points
enum { C_S_X = 0, C_S_Y = 1, C_ANCHORED = 2, C_SLIDING = 3, C_XI_LARGEST = 4, C_YAW = 5, C_ROLL_X = 6, C_ROLL_Y = 7, C_MEMORY = 8 }; // memory
enum { S_HERTZ = 0, S_HYSTERESIS = 3, S_HUNT = 6, S_ORIENTATION = 8, S_STRIBECK = 10, S_LOAD = 13, S_ADHESION = 16, S_VISCOUS = 19, S_NORMALS = 21, S_SPIN = 31, S_ROLLING = 34, S_DRAG = 36, S_CABLE = 39, S_WIRE = 46, S_VIBRATION = 51, S_TILT = 59, S_SUPPORT = 62, S_SLOTS = 70, S_CONTACT = 1, S_FORCES = 2, S_MOMENTS = 4, S_LOADS = 8, S_PLATE = 16 }; // effects
enum { M_mass, M_width, M_depth, M_height, M_g, M_foot_radius, M_points, M_K_N, M_K_T, M_beta_int, M_beta_ext, M_mu_int, M_mu_ext, M_delta_long_1, M_delta_long_2, M_delta_long_3, M_delta_long_4, M_delta_diag, M_theta_0, M_inertia_0, M_inertia_1, M_inertia_2, M_inertia_3, M_inertia_4, M_inertia_5, M_inertia_6, M_inertia_7, M_inertia_8, M_COUNT }; // model
enum { E_foot_defects_on = 0, E_foot_defects_delta_long1 = 1, E_foot_defects_delta_long2 = 2, E_foot_defects_delta_long3 = 3, E_foot_defects_delta_long4 = 4, E_foot_defects_delta_diag = 5, E_foot_defects_mu_int = 6, E_foot_defects_beta_int = 7, E_foot_defects_diag1 = 8, E_foot_defects_diag2 = 9, E_foot_defects_diag3 = 10, E_foot_defects_diag4 = 11 };
enum { E_dimension_deviation_on = 12, E_dimension_deviation_width = 13, E_dimension_deviation_depth = 14, E_dimension_deviation_height = 15, E_dimension_deviation_inertia_share = 16 };
enum { E_rounded_feet_on = 17, E_rounded_feet_radius = 18, E_rounded_feet_foot1 = 19, E_rounded_feet_foot2 = 20, E_rounded_feet_foot3 = 21, E_rounded_feet_foot4 = 22 };
enum { E_mass_eccentricity_on = 23, E_mass_eccentricity_x = 24, E_mass_eccentricity_y = 25, E_mass_eccentricity_z = 26 };
enum { E_inertia_deviation_on = 27, E_inertia_deviation_xx = 28, E_inertia_deviation_yy = 29, E_inertia_deviation_zz = 30, E_inertia_deviation_xy = 31, E_inertia_deviation_xz = 32, E_inertia_deviation_yz = 33 };
enum { E_uneven_foot_stiffness_on = 34, E_uneven_foot_stiffness_foot1 = 35, E_uneven_foot_stiffness_foot2 = 36, E_uneven_foot_stiffness_foot3 = 37, E_uneven_foot_stiffness_foot4 = 38, E_uneven_foot_stiffness_tangential_share = 39 };
enum { E_uneven_foot_damping_on = 40, E_uneven_foot_damping_foot1 = 41, E_uneven_foot_damping_foot2 = 42, E_uneven_foot_damping_foot3 = 43, E_uneven_foot_damping_foot4 = 44, E_uneven_foot_damping_normal_share = 45 };
enum { E_uneven_foot_friction_on = 46, E_uneven_foot_friction_foot1 = 47, E_uneven_foot_friction_foot2 = 48, E_uneven_foot_friction_foot3 = 49, E_uneven_foot_friction_foot4 = 50 };
enum { E_hertzian_contact_on = 51, E_hertzian_contact_exponent = 52, E_hertzian_contact_reference = 53 };
enum { E_hysteretic_contact_on = 54, E_hysteretic_contact_kappa = 55, E_hysteretic_contact_curved_share = 56 };
enum { E_hunt_crossley_contact_on = 57, E_hunt_crossley_contact_a = 58 };
enum { E_stribeck_friction_on = 59, E_stribeck_friction_ratio = 60, E_stribeck_friction_velocity = 61 };
enum { E_load_dependent_friction_on = 62, E_load_dependent_friction_exponent = 63, E_load_dependent_friction_reference = 64 };
enum { E_adhesion_on = 65, E_adhesion_force = 66, E_adhesion_range = 67 };
enum { E_viscous_friction_on = 68, E_viscous_friction_c = 69 };
enum { E_uneven_contact_normals_on = 70, E_uneven_contact_normals_x1 = 71, E_uneven_contact_normals_y1 = 72, E_uneven_contact_normals_x2 = 73, E_uneven_contact_normals_y2 = 74, E_uneven_contact_normals_x3 = 75, E_uneven_contact_normals_y3 = 76, E_uneven_contact_normals_x4 = 77, E_uneven_contact_normals_y4 = 78, E_uneven_contact_normals_turning_share = 79 };
enum { E_spin_friction_on = 80, E_spin_friction_radius = 81, E_spin_friction_sliding_share = 82 };
enum { E_rolling_resistance_on = 83, E_rolling_resistance_lever = 84 };
enum { E_quadratic_drag_on = 85, E_quadratic_drag_c = 86, E_quadratic_drag_c_v = 87 };
enum { E_cable_restraint_on = 88, E_cable_restraint_k = 89, E_cable_restraint_c = 90, E_cable_restraint_height = 91, E_cable_restraint_stiffening = 92, E_cable_restraint_reference = 93 };
enum { E_lingering_wire_pull_on = 94, E_lingering_wire_pull_force = 95, E_lingering_wire_pull_tau = 96, E_lingering_wire_pull_evenness = 97 };
enum { E_base_vibration_on = 98, E_base_vibration_amplitude = 99, E_base_vibration_frequency = 100, E_base_vibration_direction = 101, E_base_vibration_phase = 102, E_base_vibration_harmonic_cosine = 103, E_base_vibration_harmonic_sine = 104 };
enum { E_plate_tilt_on = 105, E_plate_tilt_x = 106, E_plate_tilt_y = 107 };
enum { E_compliant_support_on = 108, E_compliant_support_mass = 109, E_compliant_support_frequency = 110, E_compliant_support_ratio = 111, E_compliant_support_pitch = 112 };
enum { E_release_velocity_on = 113, E_release_velocity_x = 114, E_release_velocity_y = 115, E_release_velocity_z = 116 };
enum { E_gyro_misalignment_on = 117, E_gyro_misalignment_x = 118, E_gyro_misalignment_y = 119, E_gyro_misalignment_z = 120, E_gyro_misalignment_xy = 121, E_gyro_misalignment_xz = 122, E_gyro_misalignment_yz = 123 };
enum { E_gyro_scale_on = 124, E_gyro_scale_x = 125, E_gyro_scale_y = 126, E_gyro_scale_z = 127 };
enum { E_gyro_bandwidth_on = 128, E_gyro_bandwidth_frequency = 129, E_gyro_bandwidth_damping = 130, E_gyro_bandwidth_delay = 131 };
enum { E_gyro_drift_on = 132, E_gyro_drift_bias_x = 133, E_gyro_drift_bias_y = 134, E_gyro_drift_bias_z = 135, E_gyro_drift_rate_x = 136, E_gyro_drift_rate_y = 137, E_gyro_drift_rate_z = 138 };
enum { E_gyro_saturation_on = 139, E_gyro_saturation_range = 140, E_gyro_saturation_softness = 141 };
enum { E_clock_error_on = 142, E_clock_error_rate = 143, E_clock_error_growth = 144 };
enum { E_COUNT = 145 };
