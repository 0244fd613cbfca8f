// SPDX-License-Identifier: BSD-3-Clause
// A library for DDS as another build would have made it.
const struct {
  const char* build;
  void* open;
} fulmar_dds_library = {"0.0.0 foreign", 0};
