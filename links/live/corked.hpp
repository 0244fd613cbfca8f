// SPDX-License-Identifier: BSD-3-Clause
// TCP stream under a WebSocket that gathers frames. While it is corked, written data waits, up to a bound;
// then one system call sends all of it. Otherwise hundreds of small messages in a few milliseconds would need
// as many calls. One thread; one write at a time.
#pragma once
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffer_traits.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <cstddef>
#include <utility>
#include <vector>

namespace fulmar::core::live {

class Corked {
 public:
  using Socket = boost::asio::ip::tcp::socket;
  using executor_type = Socket::executor_type;
  using error_code = boost::system::error_code;

  explicit Corked(Socket socket) : socket_(std::move(socket)) {}
  executor_type get_executor() { return socket_.get_executor(); }
  Socket& socket() { return socket_; }
  void close() {
    error_code ignored;
    socket_.close(ignored);
  }

  /// True: another write follows the next one immediately. It must be false for the last write before a
  /// pause.
  void cork(bool on) { corked_ = on; }

  template <class Buffers, class Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    socket_.async_read_some(buffers, std::forward<Handler>(handler));
  }

  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    const std::size_t size = boost::beast::buffer_bytes(buffers), before = held_.size();
    held_.resize(before + size);
    boost::asio::buffer_copy(boost::asio::buffer(held_.data() + before, size), buffers);
    if (corked_ && held_.size() < max_held)
      return boost::asio::post(get_executor(), [size, done = std::forward<Handler>(handler)]() mutable {
        done(error_code(), size);
      });
    going_.swap(held_);
    held_.clear();
    boost::asio::async_write(socket_, boost::asio::buffer(going_),
                             [size, done = std::forward<Handler>(handler)](
                                 error_code ec, std::size_t) mutable { done(ec, ec ? 0 : size); });
  }

  template <class Handler>
  friend void async_teardown(boost::beast::role_type role, Corked& corked, Handler&& handler) {
    using boost::beast::websocket::async_teardown;
    async_teardown(role, corked.socket_, std::forward<Handler>(handler));
  }
  friend void beast_close_socket(Corked& corked) { corked.close(); }

 private:
  static constexpr std::size_t max_held = 64u << 10;
  Socket socket_;
  std::vector<char> held_, going_;
  bool corked_ = false;
};

}  // namespace fulmar::core::live
