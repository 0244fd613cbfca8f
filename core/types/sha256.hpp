// SPDX-License-Identifier: BSD-3-Clause
// Running SHA-256 (OpenSSL).
#pragma once
#include <openssl/evp.h>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "core/types/text.hpp"

namespace fulmar::core {

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new()) { EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr); }
  void add(const void* bytes, std::size_t size) noexcept { EVP_DigestUpdate(context_.get(), bytes, size); }
  /// Lower-case hex digest of all added bytes. Call once.
  std::string hex() {
    unsigned char digest[EVP_MAX_MD_SIZE];
    unsigned int size = 0;
    EVP_DigestFinal_ex(context_.get(), digest, &size);
    return hex_text(std::as_bytes(std::span(digest, size)));
  }
  static std::string of(std::string_view text) {
    Sha256 sum;
    sum.add(text.data(), text.size());
    return sum.hex();
  }

 private:
  struct Free {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
  };
  std::unique_ptr<EVP_MD_CTX, Free> context_;
};

}  // namespace fulmar::core
