/* SPDX-License-Identifier: BSD-3-Clause */
/* Outer loops in C11, with fulmar/abi.h alone: course to roll, height to pitch, airspeed to
 * throttle, all proportional. Source: Beard & McLain, Small Unmanned Aircraft (2012), chapter 6. */
#include <fulmar/abi.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

/* ---- messages: only the fields that this law reads; the host copies them by name, at any offset in the
 * writer's struct -------- */

struct state {
  double height_m, course_rad, airspeed_mps;
};
struct command {
  double course_rad, height_m, airspeed_mps, roll_feedforward_rad;
};
struct attitude { /* an output needs every field of the message */
  double roll_rad, pitch_rad, throttle_frac;
};

#define NUMBER_IN(message, member, unit, min, max)                                                \
  {                                                                                               \
#member, unit, NULL, NULL, 0, FULMAR_F64, FULMAR_SCALAR, offsetof(struct message, member), 1, \
        sizeof(double), 0, min, max, 0                                                            \
  }
#define NUMBER(message, member, unit) NUMBER_IN(message, member, unit, -INFINITY, INFINITY)
#define LENGTH(array) (sizeof(array) / sizeof *(array))
#define MESSAGE(name, message, fields)                                                  \
  {                                                                                     \
    name, "", "", fields, LENGTH(fields), sizeof(fulmar_field), sizeof(struct message), \
        _Alignof(struct message)                                                        \
  }

static const fulmar_field state_fields[] = {
    NUMBER(state, height_m, "m"),
    NUMBER(state, course_rad, "rad"),
    NUMBER(state, airspeed_mps, "m/s"),
};
static const fulmar_field command_fields[] = {
    NUMBER(command, course_rad, "rad"),
    NUMBER(command, height_m, "m"),
    NUMBER(command, airspeed_mps, "m/s"),
    NUMBER(command, roll_feedforward_rad, "rad"),
};
static const fulmar_field attitude_fields[] = {
    NUMBER(attitude, roll_rad, "rad"),
    NUMBER(attitude, pitch_rad, "rad"),
    NUMBER_IN(attitude, throttle_frac, "", 0, 1),
};
static const fulmar_type state_type = MESSAGE("VehicleState", state, state_fields);
static const fulmar_type command_type = MESSAGE("GuidanceCommand", command, command_fields);
static const fulmar_type attitude_type = MESSAGE("AttitudeCommand", attitude, attitude_fields);

/* ---- ports and parameters; the functions get them in this order
 * ------------------------------------------------------------ */

enum { IN_STATE, IN_COMMAND };
static const fulmar_port inputs[] = {
    [IN_STATE] = {"state", &state_type, FULMAR_IN_VALUE, 0, 1},
    [IN_COMMAND] = {"command", &command_type, FULMAR_IN_VALUE, 0, 1},
};

enum { OUT_ATTITUDE, OUT_HEIGHT_ERROR };
static const fulmar_port outputs[] = {
    [OUT_ATTITUDE] = {"attitude", &attitude_type, FULMAR_OUT_VALUE, 0, 1},
    [OUT_HEIGHT_ERROR] = {"height_error_m", NULL, FULMAR_OUT_PROBE, 0, 1},
};

enum { COURSE_KP, HEIGHT_KP, AIRSPEED_KP, THROTTLE_TRIM, PITCH_TRIM, ROLL_MAX, PITCH_MAX, PARAM_COUNT };
#define PARAM(name, unit, doc, initial, min, max) \
  { name, unit, doc, "", NULL, NULL, NULL, 0, FULMAR_NUMBER, FULMAR_LIVE, 0, {initial, 0, 0}, min, max }
static const fulmar_param params[PARAM_COUNT] = {
    [COURSE_KP] = PARAM("course_kp", "rad/rad", "roll per course error", 1.2, 0, 5),
    [HEIGHT_KP] = PARAM("height_kp", "rad/m", "pitch per height error", 0.03, 0, 1),
    [AIRSPEED_KP] = PARAM("airspeed_kp", "s/m", "throttle per airspeed error", 0.1, 0, 1),
    [THROTTLE_TRIM] = PARAM("throttle_trim", "", "throttle in level flight", 0.4, 0, 1),
    [PITCH_TRIM] = PARAM("pitch_trim", "rad", "pitch in level flight", 0.02, -0.3, 0.3),
    [ROLL_MAX] = PARAM("roll_max", "rad", "limit of the roll command, either way", 0.6, 0, 1.2),
    [PITCH_MAX] = PARAM("pitch_max", "rad", "limit of the pitch command, either way", 0.25, 0, 0.6),
};

/* ---- the law
 * ---------------------------------------------------------------------------------------------------------------
 */

struct law {
  double param[PARAM_COUNT];
};

static double within(double x, double low, double high) { return x < low ? low : x > high ? high : x; }

static void* create(uint64_t seed, fulmar_error* error) {
  (void)seed;
  (void)error;
  return calloc(1, sizeof(struct law));
}

static void destroy(void* self) { free(self); }

/* Serves configure and retune: all parameters each time. */
static uint32_t take_params(void* self, const fulmar_value* values, fulmar_error* error) {
  (void)error;
  for (int i = 0; i < PARAM_COUNT; ++i) ((struct law*)self)->param[i] = values[i].number[0];
  return FULMAR_OK;
}

static uint32_t step(void* self, const fulmar_tick* tick, const fulmar_input* in, fulmar_output* out,
                     fulmar_error* error) {
  (void)tick;
  (void)error;
  const double* p = ((const struct law*)self)->param;
  const struct state* x = in[IN_STATE].data;
  const struct command* c = in[IN_COMMAND].data;
  const double chi_error = remainder(c->course_rad - x->course_rad, 6.283185307179586); /* the shorter way */
  const double h_error = c->height_m - x->height_m, Va_error = c->airspeed_mps - x->airspeed_mps;
  struct attitude* attitude = out[OUT_ATTITUDE].data;
  attitude->roll_rad = within(c->roll_feedforward_rad + p[COURSE_KP] * chi_error, -p[ROLL_MAX], p[ROLL_MAX]);
  attitude->pitch_rad = within(p[PITCH_TRIM] + p[HEIGHT_KP] * h_error, -p[PITCH_MAX], p[PITCH_MAX]);
  attitude->throttle_frac = within(p[THROTTLE_TRIM] + p[AIRSPEED_KP] * Va_error, 0, 1);
  *(double*)out[OUT_HEIGHT_ERROR].data = h_error;
  out[OUT_HEIGHT_ERROR].count = 1;
  return FULMAR_OK;
}

/* ---- tables for the host
 * --------------------------------------------------------------------------------------------------- */

static const fulmar_component component = {
    .name = "CLaw",
    .doc = "Proportional course, height and airspeed hold, in C.",
    .inputs = inputs,
    .outputs = outputs,
    .params = params,
    .input_count = LENGTH(inputs),
    .output_count = LENGTH(outputs),
    .param_count = LENGTH(params),
    .port_stride = sizeof(fulmar_port),
    .param_stride = sizeof(fulmar_param),
    .create = create,
    .destroy = destroy,
    .configure = take_params,
    .retune = take_params,
    .step = step,
};

#if defined(__clang__)
#define TOOLCHAIN "clang " __clang_version__
#elif defined(__GNUC__)
#define TOOLCHAIN "gcc " __VERSION__
#else
#define TOOLCHAIN "a C compiler"
#endif

extern const fulmar_plugin fulmar_plugin_entry;
__attribute__((visibility("default"))) const fulmar_plugin fulmar_plugin_entry = {
    .abi_major = FULMAR_ABI_MAJOR,
    .abi_minor = FULMAR_ABI_MINOR,
    .component_count = 1,
    .component_stride = sizeof(fulmar_component),
    .version = "1.0.0",
    .toolchain = TOOLCHAIN,
    .flags = "",
    .components = &component,
};
