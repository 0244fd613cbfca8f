/* SPDX-License-Identifier: BSD-3-Clause */
/* A plugin of another minor version: every element of its tables is longer than this host's (a newer SDK), or
 * its entry ends where that of ABI 1.0 ended (an older SDK). */
#include <fulmar/abi.h>
#include <math.h>
#include <stddef.h>

#ifdef NEWER
#define TAIL uint64_t tail[3];
#define TAIL_VALUE \
  , { ~0ull, ~0ull, ~0ull }
#define MINOR 7
#else
#define TAIL
#define TAIL_VALUE
#define MINOR 0
#endif

typedef struct {
  fulmar_field base;
  TAIL
} field;
typedef struct {
  fulmar_port base;
  TAIL
} port;
typedef struct {
  fulmar_param base;
  TAIL
} param;
typedef struct {
  fulmar_component base;
  TAIL
} component;

static const field fields[] = {
    {{"x_m", "m", NULL, NULL, 0, FULMAR_F64, FULMAR_SCALAR, 0, 1, 8, 0, -INFINITY, INFINITY, 0} TAIL_VALUE},
    {{"y_m", "m", NULL, NULL, 0, FULMAR_F64, FULMAR_SCALAR, 8, 1, 8, 0, -INFINITY, INFINITY, 0} TAIL_VALUE},
};
static const fulmar_type point = {"Point", "", "", &fields[0].base, 2, sizeof(field), 16, 8};
static const port outputs[] = {
    {{"first", &point, FULMAR_OUT_VALUE, 0, 1} TAIL_VALUE},
    {{"second", &point, FULMAR_OUT_VALUE, 0, 1} TAIL_VALUE},
};
static const param params[] = {
    {{"gain", "", "", "", NULL, NULL, NULL, 0, FULMAR_NUMBER, 0, 0, {1, 0, 0}, 0, 2} TAIL_VALUE},
    {{"trim", "", "", "", NULL, NULL, NULL, 0, FULMAR_NUMBER, 0, 0, {0.5, 0, 0}, 0, 2} TAIL_VALUE},
};

static void* create(uint64_t seed, fulmar_error* error) {
  (void)seed;
  (void)error;
  static int self;
  return &self;
}
static void destroy(void* self) { (void)self; }
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
  (void)in;
  (void)error;
  ((double*)out[1].data)[1] = 42;
  return FULMAR_OK;
}

#define COMPONENT(text)             \
  {                                 \
    {.name = text,                  \
     .doc = "",                     \
     .outputs = &outputs[0].base,   \
     .params = &params[0].base,     \
     .output_count = 2,             \
     .param_count = 2,              \
     .port_stride = sizeof(port),   \
     .param_stride = sizeof(param), \
     .create = create,              \
     .destroy = destroy,            \
     .configure = configure,        \
     .step = step} TAIL_VALUE       \
  }
static const component components[] = {COMPONENT("One"), COMPONENT("Two")};

#ifdef NEWER
typedef struct {
  fulmar_plugin base;
  TAIL
} entry;
__attribute__((visibility("default")))
const entry fulmar_plugin_entry = {{FULMAR_ABI_MAJOR, MINOR, 2, sizeof(component), "1.0.0", "a C compiler",
                                    "", &components[0].base, NULL, NULL} TAIL_VALUE};
#else
/* As in abi.h of 1.0. */
typedef struct {
  uint32_t abi_major, abi_minor, component_count, component_stride;
  const char *version, *toolchain, *flags;
  const fulmar_component* components;
} entry_1_0;
_Static_assert(sizeof(entry_1_0) == offsetof(fulmar_plugin, open_script),
               "the entry of ABI 1.0 is the beginning of ours");
__attribute__((visibility("default"))) const entry_1_0 fulmar_plugin_entry = {
    FULMAR_ABI_MAJOR, MINOR, 2, sizeof(component), "1.0.0", "a C compiler", "", &components[0].base};
#endif
