// SPDX-License-Identifier: BSD-3-Clause
// The aircraft's model behind plain C functions: many aircraft of one airframe, stepped in one call. Arrays
// are row-major, one row an aircraft; columns are told by `fulmar_sim_columns`. SI, rad.
//
// Functions that return int give 0, or 1 with a sentence in `error`, cut to `size`. No exception leaves them.
// One handle is used by one thread at a time.
#pragma once
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#define FULMAR_SIM_API __attribute__((visibility("default")))
#else
#define FULMAR_SIM_API
#endif

#define FULMAR_SIM_ABI 1

struct fulmar_sim;

/// FULMAR_SIM_ABI of the library. Another number than the header's: do not call the rest.
FULMAR_SIM_API uint32_t fulmar_sim_abi(void);
/// Names with a blank between, in the order of a row.
FULMAR_SIM_API const char* fulmar_sim_columns(void);
FULMAR_SIM_API const char* fulmar_sim_actions(void);

/// `airframe`: a file, or one that is shipped, as in fulmar:airframes/anaconda.yaml. Null when it is refused.
/// At rest on the ground, heading north.
FULMAR_SIM_API struct fulmar_sim* fulmar_sim_new(const char* airframe, size_t count, uint32_t threads,
                                                 double origin_altitude_m, int turbulence, uint64_t seed,
                                                 char* error, size_t size);
FULMAR_SIM_API void fulmar_sim_delete(struct fulmar_sim* sim);

/// All as made anew; aircraft i draws from mix_seed(seed, i). The wind stays.
FULMAR_SIM_API int fulmar_sim_reset(struct fulmar_sim* sim, uint64_t seed, char* error, size_t size);
FULMAR_SIM_API int fulmar_sim_stand(struct fulmar_sim* sim, double heading_rad, char* error, size_t size);
/// Into steady level flight above the origin; refused where there is none.
FULMAR_SIM_API int fulmar_sim_fly(struct fulmar_sim* sim, double height_m, double airspeed_mps,
                                  double heading_rad, char* error, size_t size);
/// Velocity of the air, north, east, down, of each aircraft: count x 3.
FULMAR_SIM_API int fulmar_sim_set_wind(struct fulmar_sim* sim, const double* wind_n, char* error,
                                       size_t size);
/// `steps` steps of `dt_s` under these actions, count x 4, then the rows. Refused before anything has moved.
FULMAR_SIM_API int fulmar_sim_step(struct fulmar_sim* sim, const double* actions, double dt_s, uint32_t steps,
                                   double* rows, char* error, size_t size);
FULMAR_SIM_API int fulmar_sim_rows(const struct fulmar_sim* sim, double* rows, char* error, size_t size);
/// Of rows, the first 13 columns, surfaces and propeller. Refused as a whole.
FULMAR_SIM_API int fulmar_sim_set_rows(struct fulmar_sim* sim, const double* rows, char* error, size_t size);

#ifdef __cplusplus
}
#endif
