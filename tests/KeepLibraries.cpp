// SPDX-License-Identifier: Apache-2.0
// Libraries stay loaded in device tests under the address sanitizer: a report of a leak names the library that
// allocated, which tests/lsan.supp needs, only while it is there. The Vulkan loader closes drivers and layers with
// each instance.
extern "C" __attribute__((visibility("default"))) int dlclose(void*) { return 0; }
