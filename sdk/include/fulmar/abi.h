/* SPDX-License-Identifier: BSD-3-Clause */
/* The whole binary contract between host and plugin, for C11 and C++20. It has no C++ exception, allocator,
 * vtable or std type.
 *
 * A plugin is a shared object that exports one const symbol, `fulmar_plugin_entry` of type fulmar_plugin, and
 * nothing else. At load time the host copies all strings and tables of the entry; it keeps only the function
 * pointers.
 *
 * Thread tags state the calling thread and its limits:
 *   [setup]  the main thread, before flight or between flights; may allocate and block
 *   [tick]   the thread that runs the loop; no allocation, lock, exception or system call
 * Two threads never call a component at once.
 *
 * Text is UTF-8, NUL-terminated and never NULL. All arrays carry the stride of their elements, so that an
 * element may grow at its end within one ABI major number. Times are nanoseconds of flight time, 0 at the
 * first armed tick. */
#ifndef FULMAR_ABI_H
#define FULMAR_ABI_H

#include <stdint.h>

#define FULMAR_ABI_MAJOR 1u
#define FULMAR_ABI_MINOR 2u
#define FULMAR_VERSION "0.1.0"
#define FULMAR_ENTRY_SYMBOL "fulmar_plugin_entry"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- layout of a message --------------------------------------------------------------------------------
 */

/* clang-format off */
enum fulmar_kind {    /* kind of one element */
  FULMAR_BOOL = 1,    /* one byte, 0 or 1 */
  FULMAR_U8 = 2,
  FULMAR_I32 = 3,
  FULMAR_U32 = 4,
  FULMAR_I64 = 5,
  FULMAR_U64 = 6,
  FULMAR_F32 = 7,
  FULMAR_F64 = 8,
  FULMAR_ENUM = 9,    /* one byte; `labels` has the names of its values 0, 1, ... */
  FULMAR_TEXT = 10,   /* char[stride], NUL-terminated */
  FULMAR_STRUCT = 11, /* described by `type` */
  FULMAR_I8 = 12,     /* from ABI 1.2 on, for foreign messages; as the next two */
  FULMAR_I16 = 13,
  FULMAR_U16 = 14
};

enum fulmar_shape {
  FULMAR_SCALAR = 0,
  FULMAR_ARRAY = 1, /* `count` elements, all valid */
  FULMAR_LIST = 2   /* a uint32_t at `offset` holds the number of valid elements, at most `count`; they begin
                       at `offset` + `items` */
};

typedef struct fulmar_type fulmar_type;

typedef struct fulmar_field {
  const char* name;          /* ends in its unit: airspeed_mps */
  const char* unit;          /* as printed: "m/s"; "" for none, and inside a Vec3, whose unit stands at the
                                outer field */
  const fulmar_type* type;   /* of FULMAR_STRUCT, else NULL */
  const char* const* labels; /* of FULMAR_ENUM, else NULL */
  uint32_t label_count;
  uint32_t kind;   /* fulmar_kind */
  uint32_t shape;  /* fulmar_shape */
  uint32_t offset; /* bytes from the start of the struct */
  uint32_t count;  /* 1, the length of an array, or the capacity of a list */
  uint32_t stride; /* bytes from one element to the next */
  uint32_t items;  /* FULMAR_LIST: bytes from the field to its first element */
  double min, max; /* range that the host enforces in flight; -inf and inf without one */
  uint32_t flags;  /* fulmar_field_flags; 0 in older tables */
} fulmar_field;
/* clang-format on */

enum fulmar_field_flags {
  FULMAR_FIELD_APPENDED =
      1, /* an older writer without this field may feed a reader, which then reads zeros */
  FULMAR_FIELD_REQUIRED = 2, /* a record that is given as a whole must have this field; if it is a struct,
                                also its own required fields */
  FULMAR_FIELD_INSTEAD = 4,  /* if a record has it, it replaces the required fields of its struct */
  FULMAR_FIELD_RISING = 8    /* a list of numbers that must rise in a record */
};

struct fulmar_type {
  const char* name;  /* "VehicleState" */
  const char* frame; /* "ned", "body", "body to ned", or "" */
  const char* ros;   /* ROS type of a foreign message, else "" */
  const fulmar_field* fields;
  uint32_t field_count;
  uint32_t field_stride;
  uint32_t size;
  uint32_t align;
};

/* ---- ports --------------------------------------------------------------------------------------------- */

enum fulmar_port_kind {
  FULMAR_IN_VALUE = 1,   /* the latest sample */
  FULMAR_IN_QUEUE = 2,   /* every sample since the last step */
  FULMAR_IN_REQUEST = 3, /* as a queue; the component answers each in the same step */
  FULMAR_OUT_VALUE = 17, /* written in each step */
  FULMAR_OUT_EVENT = 18, /* a value that a step may leave unpublished */
  FULMAR_OUT_QUEUE = 19, /* zero or more samples per step */
  FULMAR_OUT_PROBE = 20  /* one number for observation: data points to a double */
};

enum { FULMAR_PORT_OPTIONAL = 1 };

/* Time of validity of a driver's sample: the time at which the loop takes it. */
#define FULMAR_ON_ARRIVAL INT64_MIN

typedef struct fulmar_port {
  const char* name;
  const fulmar_type* type; /* NULL for a probe */
  uint32_t kind;           /* fulmar_port_kind; a host rejects an unknown kind */
  uint32_t flags;
  uint32_t capacity; /* queues and requests: items per step; else 1 */
} fulmar_port;

typedef struct fulmar_tick {
  int64_t now_ns;
  int64_t dt_ns;  /* since the previous step of this component; in its first step the nominal period */
  uint64_t index; /* number of the pass of the loop, from 0 */
} fulmar_tick;

enum {
  FULMAR_FRESH = 1, /* the previous step did not read this sample */
  FULMAR_STALE = 2  /* older than the wire's max_age: last values held */
};

enum { FULMAR_UNANSWERED = 0, FULMAR_ACCEPTED = 1, FULMAR_REFUSED = 2 };

typedef struct fulmar_answer {
  uint32_t verdict;
  char reason[124];
} fulmar_answer;

typedef struct fulmar_input {
  const void* data; /* the sample, or `count` items at a distance of the type size; NULL without one */
  const int64_t* stamps_ns; /* queue, request: time of validity of each item */
  fulmar_answer* answers;   /* request: the answer to each item */
  int64_t valid_at_ns;      /* value: time of validity */
  int64_t age_ns;           /* value: now - valid_at */
  uint64_t sequence;        /* value: number of samples, from 1; 0 without one */
  uint32_t count;           /* value: 0 or 1; queue, request: items */
  uint32_t lost;            /* queue, request: items beyond the capacity since the last step */
  uint32_t flags;
  uint32_t reserved;
} fulmar_input;

typedef struct fulmar_output {
  void* data;          /* memory of the host for one value, for `capacity` items, or for a double */
  int64_t* stamps_ns;  /* queue: memory for the times of validity */
  int64_t valid_at_ns; /* set to now by the host; the component may set its own time of validity */
  uint32_t count;      /* 0 when called; event, probe: 1 when written; queue: items written; value: ignored */
  uint32_t lost;       /* queue: items beyond the capacity */
} fulmar_output;

/* ---- parameters ---------------------------------------------------------------------------------------- */

enum fulmar_param_kind {
  FULMAR_NUMBER = 1, /* number[0] */
  FULMAR_FLAG = 2,   /* integer: 0 or 1 */
  FULMAR_COUNT = 3,  /* integer */
  FULMAR_CHOICE = 4, /* integer: index into `choices` */
  FULMAR_STRING = 5, /* text */
  FULMAR_VECTOR = 6, /* number[0..2] in the frame of `type` */
  FULMAR_RECORD = 7, /* data: a struct of `type`, read by the host from a YAML file */
  FULMAR_BLOB = 8    /* data, size: the bytes of a file; text: its name */
};

enum {
  FULMAR_LIVE = 1,    /* may change between ticks */
  FULMAR_REQUIRED = 2 /* a record or blob that the component needs */
};

typedef struct fulmar_param {
  const char* name;
  const char* unit;
  const char* doc;
  const char* initial_text;   /* FULMAR_STRING */
  const char* const* choices; /* FULMAR_CHOICE */
  const fulmar_type* type;    /* FULMAR_RECORD, FULMAR_VECTOR */
  const void* initial_data;   /* FULMAR_RECORD: defaults of the struct */
  uint32_t choice_count;
  uint32_t kind;
  uint32_t flags;
  uint32_t capacity; /* FULMAR_STRING: bytes, the NUL included */
  double initial[3]; /* the integer kinds use initial[0] */
  double min, max;   /* of a number, a count, and each element of a vector */
} fulmar_param;

typedef struct fulmar_value { /* valid until configure or retune returns; data of records and blobs until the
                                 next configure */
  double number[3];
  int64_t integer;
  const char* text;
  const void* data;
  uint64_t size;
} fulmar_value;

/* ---- components ---------------------------------------------------------------------------------------- */

enum fulmar_status { FULMAR_OK = 0, FULMAR_DEGRADED = 1, FULMAR_FAILED = 2 };

typedef struct fulmar_error { /* set on FULMAR_FAILED, and when create returns NULL; may be "" */
  char text[248];
} fulmar_error;

enum {
  FULMAR_VEHICLE = 1, /* has read and write in place of step */
  FULMAR_RESIDENT = 2 /* its library cannot be unloaded; it has its own way of a swap */
};

/* Inputs, outputs, parameters and values are in the order of the tables. */
typedef struct fulmar_component {
  const char* name; /* "Outer"; a plugin's only component may be addressed by the file alone */
  const char* doc;
  const fulmar_port* inputs;
  const fulmar_port* outputs;
  const fulmar_param* params;
  uint32_t input_count, output_count, param_count;
  uint32_t port_stride, param_stride;
  uint32_t flags;

  /* clang-format off */
  void* (*create)(uint64_t seed, fulmar_error*);                           /* [setup] NULL on failure */
  void (*destroy)(void*);                                                  /* [setup] not active */
  uint32_t (*configure)(void*, const fulmar_value* values, fulmar_error*); /* [setup] all parameters */
  uint32_t (*retune)(void*, const fulmar_value* values, fulmar_error*);
                                                /* [tick] all parameters, between steps; may be NULL */
  uint32_t (*activate)(void*, const fulmar_tick*,
                       const fulmar_input* inputs, /* [tick] may be NULL; last: one per output, */
                       const fulmar_input* last, fulmar_error*);
                                                /*        what was last applied in its role */
  void (*deactivate)(void*);                    /* [tick] may be NULL */
  uint32_t (*step)(void*, const fulmar_tick*, const fulmar_input*, fulmar_output*, fulmar_error*);
                                                /* [tick] */
  uint32_t (*read)(void*, fulmar_tick*, fulmar_output*, fulmar_error*);
                                                /* [tick] vehicle: sets now_ns, strictly increasing */
  uint32_t (*write)(void*, const fulmar_tick*, const fulmar_input*, fulmar_error*);
                                                /* [tick] vehicle: drives the actuators */
  const void* (*get_extension)(const char* id); /* [setup] may be NULL; NULL: not supported */
  /* clang-format on */
} fulmar_component;

/* Extension "fulmar.last_frame" of a vehicle: const fulmar_last_frame* (*)(void* instance, const
 * fulmar_input* inputs, fulmar_error*).  [setup] Encodes the data for its device in case of a crash of the
 * host, from inputs that hold the mission's failsafe. The signal handler of the host writes `data` to `fd`
 * once. The struct keeps its address for the life of the instance; the vehicle updates `fd`. */
#define FULMAR_LAST_FRAME "fulmar.last_frame"
typedef struct fulmar_last_frame {
  volatile int32_t fd; /* -1: no device at present */
  uint32_t size;
  uint8_t data[504];
} fulmar_last_frame;
typedef const fulmar_last_frame* (*fulmar_last_frame_function)(void*, const fulmar_input*, fulmar_error*);

typedef struct fulmar_plugin {
  uint32_t abi_major, abi_minor; /* always first: read before anything else */
  uint32_t component_count;
  uint32_t component_stride;
  const char* version;   /* of the plugin */
  const char* toolchain; /* compiler and its version */
  const char* flags;     /* relevant build flags: "NDEBUG", "sanitized", "" */
  const fulmar_component* components;
  /* From ABI 1.1 on. A plugin for another language creates the components of a file of that language; NULL
   * for other plugins.  [setup] The result of open_script is valid until close_script; NULL and a text on
   * failure. Such a plugin may have no components of its own. */
  const struct fulmar_plugin* (*open_script)(const char* file, const char* text, uint64_t size,
                                             fulmar_error*);
  void (*close_script)(const struct fulmar_plugin*);
} fulmar_plugin;

#ifdef __cplusplus
}
#endif
#endif
