// SPDX-License-Identifier: MIT
#include "tools/run.h"

int main(int argc, char **argv) {
    return threefold::run(argc, argv, threefold::built_in_scenes(), threefold::built_in_claims());
}
