#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/io/npy.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

namespace {

/// What numpy.save writes: a header of 118 bytes, padded with spaces, so that the data begins at byte 128.
std::string numpy_file(const std::string& dictionary, const std::string& data) {
  std::string header = dictionary;
  header.resize(117, ' ');
  return std::string("\x93NUMPY\x01\x00v\x00", 10) + header + '\n' + data;
}

const std::string floats = numpy_file("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }",
                                      std::string("\x00\x00\xc0\x3f\x00\x00\x00\xc0\x00\x00\x00\x00"
                                                  "\x00\x00\x80\x7f\x00\x00\x50\x40\xc2\x16\x01\x00",
                                                  24));
const std::string two_bytes = numpy_file("{'descr': '|u1', 'fortran_order': False, 'shape': (2,), }", "\x07\xff");
const std::string ints = numpy_file("{'descr': '<i4', 'fortran_order': False, 'shape': (2,), }",
                                    std::string("\xff\xff\xff\xff\xff\xff\xff\x7f", 8));
const std::string scalar = numpy_file("{'descr': '<f8', 'fortran_order': False, 'shape': (), }",
                                      std::string("\x00\x00\x00\x00\x00\x00\x04\x40", 8));

template <class Number = float>
std::string numpy_refusal(const std::string& content) {
  return refusal([&] { return decode_npy<Number>(content, "a.npy"); });
}

/// A file with 24 bytes of data behind this dictionary.
std::string numpy_with_header(const std::string& dictionary) { return numpy_file(dictionary, std::string(24, '\0')); }

template <class Number>
void round_trip(const std::vector<std::size_t>& shape, std::uint64_t seed) {
  const io_test::TemporaryFolder folder;
  Random random(seed);
  NpyArray<Number> array{shape, {}};
  std::size_t count = 1;
  for (const std::size_t side : shape) count *= side;
  for (std::size_t i = 0; i < count; ++i) array.values.push_back(static_cast<Number>(random.uniform(0.0, 250.0)));
  write_npy(folder / "a.npy", array);
  const NpyArray<Number> back = read_npy<Number>(folder / "a.npy");
  CHECK(back.shape == array.shape);
  CHECK(back.values == array.values);
  CHECK(folder.names() == std::vector<std::string>{"a.npy"});
  CHECK((io_test::content_of(folder / "a.npy").size() - count * sizeof(Number)) % 64 == 0);
}

}  // namespace

TEST_CASE("npy: what numpy.save wrote is read") {
  const NpyArray<float> read = decode_npy<float>(floats, "a.npy");
  CHECK(read.shape == std::vector<std::size_t>{2, 3});
  CHECK(read.values[0] == 1.5F);
  CHECK(read.values[1] == -2.0F);
  CHECK(read.values[3] == std::numeric_limits<float>::infinity());
  CHECK(read.values[4] == 3.25F);
  CHECK(read.values[5] == 1e-40F);
  CHECK(decode_npy<std::uint8_t>(two_bytes, "a.npy").values == std::vector<std::uint8_t>{7, 255});
  CHECK(decode_npy<std::int32_t>(ints, "a.npy").values == std::vector<std::int32_t>{-1, 2147483647});
  CHECK(decode_npy<double>(scalar, "a.npy").values == std::vector<double>{2.5});
  CHECK(decode_npy<double>(scalar, "a.npy").shape.empty());
}

TEST_CASE("npy: what is written is what numpy.save writes, to the byte") {
  CHECK(encode_npy(decode_npy<float>(floats, "a.npy")) == floats);
  CHECK(encode_npy(decode_npy<std::uint8_t>(two_bytes, "a.npy")) == two_bytes);
  CHECK(encode_npy(decode_npy<std::int32_t>(ints, "a.npy")) == ints);
  CHECK(encode_npy(decode_npy<double>(scalar, "a.npy")) == scalar);
  CHECK(encode_npy(NpyArray<float>{{0, 3}, {}}) ==
        numpy_file("{'descr': '<f4', 'fortran_order': False, 'shape': (0, 3), }", ""));
}

TEST_CASE("npy: arrays of every type and shape come back") {
  for (const std::vector<std::size_t>& shape : std::vector<std::vector<std::size_t>>{
           {}, {1}, {7}, {3, 5}, {0}, {4, 0, 2}, {2, 3, 4, 5}, std::vector<std::size_t>(32, 1)}) {
    round_trip<float>(shape, 1);
    round_trip<double>(shape, 2);
    round_trip<std::uint8_t>(shape, 3);
    round_trip<std::int32_t>(shape, 4);
  }
}

TEST_CASE("npy: headers in another order and form are read") {
  for (const std::string dictionary :
       {"{\"shape\": (2,3),\"fortran_order\":False,\"descr\":\"<f4\"}",
        "  { 'shape' : ( 2 , 3 , ) , 'descr' : '<f4' , 'fortran_order' : False }  "}) {
    CHECK(decode_npy<float>(numpy_with_header(dictionary), "a.npy").shape == std::vector<std::size_t>{2, 3});
  }
}

TEST_CASE("npy: what is not understood is refused") {
  for (const auto& [dictionary, what] : std::vector<std::pair<std::string, std::string>>{
           {"{'descr': '<f4', 'fortran_order': True, 'shape': (2, 3), }", "Fortran order"},
           {"{'descr': '>f4', 'fortran_order': False, 'shape': (2, 3), }", "numbers are \">f4\", but must be \"<f4\""},
           {"{'descr': '<f8', 'fortran_order': False, 'shape': (3,), }", "numbers are \"<f8\""},
           {"{'descr': '|O', 'fortran_order': False, 'shape': (3,), }", "numbers are \"|O\""},
           {"{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (6,), }", "text in quotes"},
           {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 4), }", "asks for 32 bytes of data, but 24 follow"},
           {"{'descr': '<f4', 'fortran_order': False, 'shape': (5,), }", "asks for 20 bytes of data, but 24 follow"},
           {"{'descr': '<f4', 'fortran_order': False, 'shape': (6), }", "no tuple"},
           {"{'descr': '<f4', 'fortran_order': False, 'shape': (2 3), }", "no comma"},
           {"{'descr': '<f4', 'fortran_order': False, 'shape': (-6,), }", "not a whole number"},
           {"{'descr': '<f4', 'fortran_order': False, 'shape': (2.0, 3), }", "no comma"},
           {"{'descr': '<f4', 'fortran_order': False, 'shape': (9999999999999999999,), }", "18 digits"},
           {"{'descr': '<f4', 'fortran_order': False, 'shape': (99999999999, 99999999999), }", "far too many"},
           {"{'descr': '<f4', 'fortran_order': False, 'shape': 6, }", "where a ( is awaited"},
           {"{'descr': '<f4', 'fortran_order': 0, 'shape': (6,), }", "neither True nor False"},
           {"{'descr': '<f4', 'fortran_order': False, }", "lacks one of"},
           {"{'descr': '<f4', 'descr': '<f4', 'fortran_order': False, 'shape': (6,)}", "\"descr\" that is not awaited"},
           {"{'descr': '<f4', 'fortran_order': False, 'shape': (6,), 'more': 1}", "\"more\" that is not awaited"},
           {"{'descr': '<f4', 'fortran_order': False, 'shape': (6,)", "where a } is awaited"},
           {"{'descr': '<f4', 'fortran_order': False, 'shape': (6,)} 1", "goes on after its dictionary"},
           {"{'descr': '<f4, 'fortran_order': False, 'shape': (6,)}", "where a } is awaited"},
           {"", "where a { is awaited"}}) {
    CAPTURE(dictionary);
    CHECK_THAT(numpy_refusal(numpy_with_header(dictionary)), Contains("a.npy: not a valid .npy: ") && Contains(what));
  }
  CHECK_THAT(numpy_refusal(""), Contains("must start with"));
  CHECK_THAT(numpy_refusal("\x93NUMPY\x01"), Contains("ends before its header"));
  std::string version = floats;
  version[6] = 2;
  CHECK_THAT(numpy_refusal(version), Contains("version 2.0, but must be of 1.0"));
  CHECK_THAT(numpy_refusal(floats.substr(0, 100)), Contains("its header has 118 bytes, but 90 follow"));
  CHECK_THAT(numpy_refusal(floats.substr(0, floats.size() - 1)), Contains("asks for 24 bytes of data, but 23 follow"));
  CHECK_THAT(numpy_refusal<double>(floats), Contains("numbers are \"<f4\", but must be \"<f8\""));
  CHECK_THAT(refusal([] { return read_npy<float>("missing.npy"); }), Contains("no such file"));
}

TEST_CASE("npy: arrays that cannot be written") {
  CHECK_THROWS_AS(encode_npy(NpyArray<float>{{2, 2}, {1.0F}}), std::invalid_argument);
  CHECK_THROWS_AS(encode_npy(NpyArray<float>{std::vector<std::size_t>(33, 1), {1.0F}}), std::invalid_argument);
  const std::size_t huge = std::numeric_limits<std::size_t>::max() / 2;
  CHECK_THROWS_AS(encode_npy(NpyArray<float>{{huge, 4}, {}}), std::invalid_argument);
  CHECK_THAT(refusal([] {
               write_npy("/proc/none/a.npy", NpyArray<float>{{0}, {}});
               return 0;
             }),
             Contains("cannot be written"));
}

TEST_CASE("npy: files cut off or spoilt are read or refused") {
  for (std::size_t size = 0; size < floats.size(); ++size) CHECK_FALSE(numpy_refusal(floats.substr(0, size)).empty());
  CHECK(io_test::refused_when_spoilt(floats, 5000, [](const std::string& text) {
          return decode_npy<float>(text, "a.npy");
        }) > 1000);
}
