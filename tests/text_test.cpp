// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "exporter/text.h"

namespace threefold {
namespace {

TEST(OneLine, OfNothingIsNothing) {
    EXPECT_EQ(one_line(""), "");
    EXPECT_EQ(one_line(" \n\t"), "");
    EXPECT_EQ(one_line("a\nb\x7f\n"), "a b");
}

TEST(Reason, IsUnknownWhereNothingIsSaid) {
    EXPECT_EQ(reason(""), "unknown reason");
    EXPECT_EQ(reason("\n"), "unknown reason");
    EXPECT_EQ(reason("no\nmemory\n"), "no memory");
}

} // namespace
} // namespace threefold
