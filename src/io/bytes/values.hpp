#pragma once

#include <cstdint>

#include <gale/io/bytes/byte_order.hpp>
#include <gale/io/bytes/text_reader.hpp>
#include <gale/io/bytes/value_type.hpp>

namespace gale::io::detail {

/// The next `count` values. Memory is taken as they arrive: a file that claims more than it has costs nothing. Throws
/// gale::Error if the source ends before.
PointArray::Values read_values(ByteSource& source, ValueType type, std::uint64_t count, ByteOrder order);

/// The next `count` numbers of a text. Throws gale::Error if there are less, or for one that the type doesn't hold.
PointArray::Values read_text_values(TextReader& text, ValueType type, std::uint64_t count);

/// All numbers up to the end of a text.
PointArray::Values read_all_text_values(TextReader& text, ValueType type);

/// The product of the factors. Throws gale::Error if it is above 2^62, or a factor below 0. `what` they are is for the
/// message.
std::uint64_t product(std::initializer_list<std::int64_t> factors, const char* what);

}  // namespace gale::io::detail
