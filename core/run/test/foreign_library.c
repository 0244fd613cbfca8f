// SPDX-License-Identifier: BSD-3-Clause
// The libraries of the host as another build would have made them.
struct table {
  const char* build;
  void* open;
};
const struct table fulmar_dds_library = {"0.0.0 foreign", 0};
const struct table fulmar_live_library = {"0.0.0 foreign", 0};
