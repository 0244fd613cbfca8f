/* SPDX-License-Identifier: BSD-3-Clause */
/* A small plugin with one fault, chosen by the build: one file for each error of the host. */
#include <fulmar/abi.h>
#include <math.h>
#include <signal.h>
#include <stddef.h>
#include <stdlib.h>
#include <unistd.h>

#ifndef ABI_MAJOR
#define ABI_MAJOR FULMAR_ABI_MAJOR
#endif
#ifndef ABI_MINOR
#define ABI_MINOR FULMAR_ABI_MINOR
#endif
#ifndef PORT_KIND
#define PORT_KIND FULMAR_OUT_VALUE
#endif
#ifndef PARAM_KIND
#define PARAM_KIND FULMAR_NUMBER
#endif
#ifndef FIELD_KIND
#define FIELD_KIND FULMAR_F64
#endif
#ifndef SECOND_OFFSET
#define SECOND_OFFSET 8
#endif
#ifndef SECOND_NAME
#define SECOND_NAME "y_m"
#endif
#ifndef SECOND_COUNT
#define SECOND_COUNT 1
#endif
#ifndef DEFAULT
#define DEFAULT 1
#endif
#ifndef DOC
#define DOC "A plugin with a fault."
#endif
#ifndef STEP
#define STEP step
#endif
#ifndef PORT_STRIDE
#define PORT_STRIDE sizeof(fulmar_port)
#endif
#ifndef FLAGS
#define FLAGS 0
#endif

static const fulmar_field fields[] = {
    {"x_m", "m", NULL, NULL, 0, FIELD_KIND, FULMAR_SCALAR, 0, 1, 8, 0, -INFINITY, INFINITY, 0},
    {SECOND_NAME, "m", NULL, NULL, 0, FULMAR_F64, FULMAR_SCALAR, SECOND_OFFSET, SECOND_COUNT, 8, 0, -INFINITY,
     INFINITY, 0},
};
static const fulmar_type point = {"Point", "", "", fields, 2, sizeof(fulmar_field), 16, 8};
static const fulmar_port outputs[] = {{"place", &point, PORT_KIND, 0, 1}};
static const fulmar_param params[] = {
    {"gain", "", "", "", NULL, NULL, NULL, 0, PARAM_KIND, 0, 0, {DEFAULT, 0, 0}, 0, 2}};

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
uint32_t step(void* self, const fulmar_tick* tick, const fulmar_input* in, fulmar_output* out,
              fulmar_error* error);
uint32_t step(void* self, const fulmar_tick* tick, const fulmar_input* in, fulmar_output* out,
              fulmar_error* error) {
  (void)self;
  (void)tick;
  (void)in;
  (void)out;
  (void)error;
  return FULMAR_OK;
}

static const fulmar_component component = {
    .name = "Point",
    .doc = DOC,
    .outputs = outputs,
    .params = params,
    .output_count = 1,
    .param_count = 1,
    .port_stride = PORT_STRIDE,
    .param_stride = sizeof(fulmar_param),
    .flags = FLAGS,
    .create = create,
    .destroy = destroy,
    .configure = configure,
    .step = STEP,
};

#ifndef NO_ENTRY
__attribute__((visibility("default"))) const fulmar_plugin fulmar_plugin_entry = {
    ABI_MAJOR, ABI_MINOR, 1, sizeof(fulmar_component), "1.0.0", "a C compiler", "", &component, NULL, NULL,
};
#else
__attribute__((visibility("default"))) const fulmar_component* another_symbol(void);
const fulmar_component* another_symbol(void) { return &component; }
#endif

#ifdef CHANGES_ROUNDING
#include <fenv.h>
#define AT_LOAD fesetround(FE_TOWARDZERO)
#endif
#ifdef AT_LOAD
__attribute__((constructor)) static void at_load(void) { AT_LOAD; }
#endif
#ifdef AT_UNLOAD
__attribute__((destructor)) static void at_unload(void) { AT_UNLOAD; }
#endif
#ifdef CALLS
int CALLS(void);
__attribute__((constructor)) static void call(void) { CALLS(); }
#endif
