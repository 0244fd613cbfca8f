// SPDX-License-Identifier: BSD-3-Clause
// Another vendor's DDS: reads or writes a topic of fulmar_msgs/msg/Mixed.
//   dds_cyclone read DOMAIN TOPIC N     prints each sample; read_late: what was sent before, too
//   dds_cyclone write DOMAIN TOPIC N    sends N samples to the first reader: speed_mps 1.5, 2.5, ...
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "messages.h"

typedef fulmar_msgs_msg_dds__Mixed_ Mixed;
typedef fulmar_msgs_msg_dds__Leg_ Leg;

enum { patience_ms = 20000 };

static void print(const Mixed* m) {
  printf("%d %.17g %u [%.17g %.17g %.17g] '%s' [", m->armed, m->speed_mps, m->count, m->gains_ratio[0],
         m->gains_ratio[1], m->gains_ratio[2], m->name);
  for (uint32_t i = 0; i < m->samples_volt._length; ++i) printf("%.17g ", m->samples_volt._buffer[i]);
  printf("] %u %lld %.9g %d (%.17g %.17g %.17g) '%s' '%s'", m->mode, (long long)m->stamp_ns,
         (double)m->load_ratio, m->offset, m->attitude_std_rad.north, m->attitude_std_rad.east,
         m->attitude_std_rad.down, m->tags[0], m->tags[1]);
  for (uint32_t i = 0; i < m->legs._length; ++i) {
    const Leg* leg = &m->legs._buffer[i];
    printf(" {%u %d %.17g (%.17g %.17g %.17g)}", leg->kind, leg->has_course, leg->course_rad,
           leg->position_m.north, leg->position_m.east, leg->position_m.down);
  }
  printf("\n");
  fflush(stdout);
}

static int read_topic(dds_entity_t participant, dds_entity_t topic, const dds_qos_t* qos, int n) {
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL);
  for (int waited = 0; n > 0 && waited < patience_ms; waited += 5) {
    void* sample = NULL;
    dds_sample_info_t info;
    while (n > 0 && dds_take(reader, &sample, &info, 1, 1) > 0) {
      if (info.valid_data) {
        print(sample);
        --n;
      }
      dds_return_loan(reader, &sample, 1);
      sample = NULL;
    }
    dds_sleepfor(DDS_MSECS(5));
  }
  return n > 0;
}

static int write_topic(dds_entity_t participant, dds_entity_t topic, const dds_qos_t* qos, int n) {
  const dds_entity_t writer = dds_create_writer(participant, topic, qos, NULL);
  dds_publication_matched_status_t matched = {0};
  for (int waited = 0; matched.current_count == 0 && waited < patience_ms; waited += 5) {
    dds_sleepfor(DDS_MSECS(5));
    dds_get_publication_matched_status(writer, &matched);
  }
  dds_sleepfor(DDS_MSECS(500));  // the reader must discover this writer, too
  double volts[2] = {0.5, 1.0};
  Leg legs[1] = {{1, true, 0.5, {3, 4, 5}}};
  Mixed m;
  memset(&m, 0, sizeof m);
  m.armed = true;
  m.count = 7;
  m.mode = 1;
  m.stamp_ns = -2;
  m.load_ratio = 0.25F;
  m.offset = -3;
  m.gains_ratio[0] = 1;
  m.gains_ratio[1] = 2;
  m.gains_ratio[2] = -2;
  m.name = "ab";
  m.tags[0] = "x";
  m.tags[1] = "yzw";
  m.samples_volt._length = m.samples_volt._maximum = 2;
  m.samples_volt._buffer = volts;
  m.attitude_std_rad.north = 0.5;
  m.attitude_std_rad.east = 1;
  m.attitude_std_rad.down = 2;
  m.legs._length = m.legs._maximum = 1;
  m.legs._buffer = legs;
  for (int i = 0; i < n; ++i) {
    m.speed_mps = 1.5 + i;
    if (dds_write(writer, &m) != DDS_RETCODE_OK) return 1;
  }
  dds_wait_for_acks(writer, DDS_MSECS(patience_ms));
  return matched.current_count == 0;
}

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const dds_entity_t participant = dds_create_participant((dds_domainid_t)atoi(argv[2]), NULL, NULL);
  if (participant < 0) return 3;
  const dds_entity_t topic =
      dds_create_topic(participant, &fulmar_msgs_msg_dds__Mixed__desc, argv[3], NULL, NULL);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 50);
  if (strcmp(argv[1], "read_late") == 0) dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  const int n = atoi(argv[4]);
  const int result = strncmp(argv[1], "read", 4) == 0 ? read_topic(participant, topic, qos, n)
                                                      : write_topic(participant, topic, qos, n);
  dds_delete_qos(qos);
  dds_delete(participant);
  return result;
}
