#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace sweep_guard_fuzz {

/// Turns the bytes of a fuzzer into values. Behind the last byte everything is 0.
class Input {
 public:
  Input(const std::uint8_t* bytes, size_t size) : bytes_(bytes), size_(size) {}

  bool atEnd() const { return size_ == 0; }

  template <typename Number>
  Number raw() {
    Number number{};
    const size_t taken = std::min(size_, sizeof(Number));
    std::memcpy(&number, bytes_, taken);
    skip(taken);
    return number;
  }
  int byte() { return raw<std::uint8_t>(); }
  bool flag() { return byte() % 2 != 0; }
  int below(int count) { return byte() % count; }                                 ///< 0 to count - 1; count <= 256
  double fraction() { return static_cast<double>(raw<std::int16_t>()) / 32767; }  ///< about -1 to 1

  /// Takes a text up to the next byte 0, or up to the end.
  std::string word() {
    const std::uint8_t* const end = std::find(bytes_, bytes_ + size_, 0);
    std::string text(bytes_, end);
    skip(std::min(text.size() + 1, size_));
    return text;
  }
  std::string rest() {
    std::string text(bytes_, bytes_ + size_);
    skip(size_);
    return text;
  }

 private:
  void skip(size_t count) {
    bytes_ += count;
    size_ -= count;
  }

  const std::uint8_t* bytes_;
  size_t size_;
};

}  // namespace sweep_guard_fuzz
