// SPDX-License-Identifier: MIT
// A shared library that is no module of Threefold.
extern "C" int threefold_no_pictures() { return 0; }
