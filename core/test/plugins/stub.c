/* SPDX-License-Identifier: BSD-3-Clause */
/* A library that is there when a plugin is linked and not when it is loaded. */
int fulmar_test_stub(void);
int fulmar_test_stub(void) { return 1; }
