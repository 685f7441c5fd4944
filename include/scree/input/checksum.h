// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_input_checksum_h
#define scree_input_checksum_h

#include <boost/crc.hpp>

#include <cstdint>

namespace scree
{
  /// CRC-64 as of ECMA-182, reflected: that of xz.
  using Checksum = boost::crc_optimal<64, 0x42F0E1EBA9EA3693, 0xFFFFFFFFFFFFFFFF, 0xFFFFFFFFFFFFFFFF, true, true>;
} // namespace scree

#endif
