// SPDX-License-Identifier: BSD-3-Clause
// Libraries of the host from another build.
struct table {
  const char* build;
  void* open;
};
const struct table fulmar_dds_library = {"0.0.0 foreign", 0};
const struct table fulmar_live_library = {"0.0.0 foreign", 0};
