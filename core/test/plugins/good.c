/* SPDX-License-Identifier: BSD-3-Clause */
/* A complete plugin in plain C, straight against the contract: one component that multiplies an airspeed. */
#include <fulmar/abi.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

#ifndef FACTOR
#define FACTOR 2.0
#define VERSION "1.2.0"
#endif

struct sample {
  double airspeed_mps;
  double position_m[3];
  uint8_t mode;
  uint8_t valid;
};

static const char* const modes[] = {"idle", "glide"};
static const fulmar_field axes[] = {
    {"north", "", NULL, NULL, 0, FULMAR_F64, FULMAR_SCALAR, 0, 1, 8, 0, -INFINITY, INFINITY, 0},
    {"east", "", NULL, NULL, 0, FULMAR_F64, FULMAR_SCALAR, 8, 1, 8, 0, -INFINITY, INFINITY, 0},
    {"down", "", NULL, NULL, 0, FULMAR_F64, FULMAR_SCALAR, 16, 1, 8, 0, -INFINITY, INFINITY, 0},
};
static const fulmar_type vector = {"Vec3", "ned", "", axes, 3, sizeof(fulmar_field), 24, 8};
static const fulmar_field fields[] = {
    {"airspeed_mps", "m/s", NULL, NULL, 0, FULMAR_F64, FULMAR_SCALAR, offsetof(struct sample, airspeed_mps),
     1, 8, 0, -INFINITY, INFINITY, 0},
    {"position_m", "m", &vector, NULL, 0, FULMAR_STRUCT, FULMAR_SCALAR, offsetof(struct sample, position_m),
     1, 24, 0, -INFINITY, INFINITY, 0},
    {"mode", "", NULL, modes, 2, FULMAR_ENUM, FULMAR_SCALAR, offsetof(struct sample, mode), 1, 1, 0,
     -INFINITY, INFINITY, 0},
    {"valid", "", NULL, NULL, 0, FULMAR_BOOL, FULMAR_SCALAR, offsetof(struct sample, valid), 1, 1, 0,
     -INFINITY, INFINITY, 0},
};
static const fulmar_type sample_type = {
    "Sample", "", "", fields, 4, sizeof(fulmar_field), sizeof(struct sample), 8};

static const fulmar_port inputs[] = {
    {"state", &sample_type, FULMAR_IN_VALUE, 0, 1},
    {"hint", &sample_type, FULMAR_IN_VALUE, FULMAR_PORT_OPTIONAL, 1},
    {"edits", &sample_type, FULMAR_IN_QUEUE, 0, 16},
    {"edit", &sample_type, FULMAR_IN_REQUEST, FULMAR_PORT_OPTIONAL, 4},
};
static const fulmar_port outputs[] = {
    {"scaled", &sample_type, FULMAR_OUT_VALUE, 0, 1},
    {"news", &sample_type, FULMAR_OUT_EVENT, 0, 1},
    {"events", &sample_type, FULMAR_OUT_QUEUE, 0, 8},
    {"error_mps", NULL, FULMAR_OUT_PROBE, 0, 1},
};

static const struct sample initial = {17.0, {1.0, 2.0, -70.0}, 1, 1};
static const char* const laws[] = {"hold", "climb"};
static const fulmar_param params[] = {
    {"gain",
     "rad/rad",
     "multiplies",
     "",
     NULL,
     NULL,
     NULL,
     0,
     FULMAR_NUMBER,
     FULMAR_LIVE,
     0,
     {0.5, 0, 0},
     0,
     2},
    {"on", "", "does anything", "", NULL, NULL, NULL, 0, FULMAR_FLAG, FULMAR_LIVE, 0, {1, 0, 0}, 0, 1},
    {"repeats", "", "how often", "", NULL, NULL, NULL, 0, FULMAR_COUNT, 0, 0, {3, 0, 0}, 0, 10},
    {"law", "", "which one", "", laws, NULL, NULL, 2, FULMAR_CHOICE, FULMAR_LIVE, 0, {1, 0, 0}, 0, 1},
    {"label", "", "a word", "x", NULL, NULL, NULL, 0, FULMAR_STRING, 0, 32, {0, 0, 0}, 0, 0},
    {"wind",
     "m/s",
     "of the air",
     "",
     NULL,
     &vector,
     NULL,
     0,
     FULMAR_VECTOR,
     FULMAR_LIVE,
     0,
     {3, -4, 0},
     -30,
     30},
    {"start",
     "",
     "where it begins",
     "",
     NULL,
     &sample_type,
     &initial,
     0,
     FULMAR_RECORD,
     0,
     0,
     {0, 0, 0},
     0,
     0},
    {"table", "", "bytes", "", NULL, NULL, NULL, 0, FULMAR_BLOB, FULMAR_REQUIRED, 0, {0, 0, 0}, 0, 0},
};

static void* create(uint64_t seed, fulmar_error* error) {
  (void)error;
  uint64_t* self = malloc(sizeof *self);
  if (self != NULL) *self = seed;
  return self;
}

static void destroy(void* self) { free(self); }

static uint32_t configure(void* self, const fulmar_value* values, fulmar_error* error) {
  (void)self;
  (void)values;
  (void)error;
  return FULMAR_OK;
}

static uint32_t step(void* self, const fulmar_tick* tick, const fulmar_input* in, fulmar_output* out,
                     fulmar_error* error) {
  (void)self;
  (void)tick;
  (void)error;
  *(struct sample*)out[0].data = *(const struct sample*)in[0].data;
  ((struct sample*)out[0].data)->airspeed_mps *= FACTOR;
  return FULMAR_OK;
}

static const fulmar_component component = {
    .name = "Scaler",
    .doc = "Multiplies an airspeed.",
    .inputs = inputs,
    .outputs = outputs,
    .params = params,
    .input_count = 4,
    .output_count = 4,
    .param_count = 8,
    .port_stride = sizeof(fulmar_port),
    .param_stride = sizeof(fulmar_param),
    .create = create,
    .destroy = destroy,
    .configure = configure,
    .step = step,
};

__attribute__((visibility("default"))) const fulmar_plugin fulmar_plugin_entry = {
    FULMAR_ABI_MAJOR,
    FULMAR_ABI_MINOR,
    1,
    sizeof(fulmar_component),
    VERSION,
    "a C compiler",
    "NDEBUG",
    &component,
    NULL,
    NULL,
};

/* Something else that is visible in the source: the version script hides it. */
__attribute__((visibility("default"))) int an_extra_symbol(void);
__attribute__((visibility("default"))) int an_extra_symbol(void) { return 42; }
