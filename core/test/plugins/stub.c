/* SPDX-License-Identifier: BSD-3-Clause */
/* A library that exists when a plugin is linked and is missing when it is loaded. */
int fulmar_test_stub(void);
int fulmar_test_stub(void) { return 1; }
