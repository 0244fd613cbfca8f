// SPDX-License-Identifier: BSD-3-Clause
// A TCP stream under a WebSocket that gathers frames: as long as it is corked, up to a bound, what is written waits; then all goes in one
// system call. Hundreds of small messages in a few milliseconds would else be as many calls. One thread; one write at a time.
#pragma once
#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/bind_handler.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <cstddef>
#include <utility>
#include <vector>

namespace fulmar::core::live {

class Corked {
 public:
  using Stream = boost::beast::tcp_stream;
  using executor_type = Stream::executor_type;
  using error_code = boost::beast::error_code;

  explicit Corked(boost::asio::ip::tcp::socket socket) : stream_(std::move(socket)) {}
  executor_type get_executor() { return stream_.get_executor(); }
  Stream& next_layer() { return stream_; }
  const Stream& next_layer() const { return stream_; }

  /// On: more will be written right after what is written next. The last write before a pause has to find it off.
  void cork(bool on) { corked_ = on; }

  template <class Buffers, class Handler>
  auto async_read_some(const Buffers& buffers, Handler&& handler) {
    return stream_.async_read_some(buffers, std::forward<Handler>(handler));
  }

  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    const std::size_t size = boost::beast::buffer_bytes(buffers), before = held_.size();
    held_.resize(before + size);
    boost::asio::buffer_copy(boost::asio::buffer(held_.data() + before, size), buffers);
    if (corked_ && held_.size() < most_held) {
      boost::asio::post(get_executor(), boost::beast::bind_front_handler(std::forward<Handler>(handler), error_code(), size));
      return;
    }
    going_.swap(held_);
    held_.clear();
    boost::asio::async_write(
        stream_, boost::asio::buffer(going_),
        [size, done = std::forward<Handler>(handler)](error_code ec, std::size_t) mutable { std::move(done)(ec, ec ? 0 : size); });
  }

  template <class Handler>
  friend void async_teardown(boost::beast::role_type role, Corked& corked, Handler&& handler) {
    using boost::beast::websocket::async_teardown;
    async_teardown(role, corked.stream_, std::forward<Handler>(handler));
  }

 private:
  static constexpr std::size_t most_held = 64u << 10;
  Stream stream_;
  std::vector<char> held_, going_;
  bool corked_ = false;
};

}  // namespace fulmar::core::live
