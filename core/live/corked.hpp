// SPDX-License-Identifier: BSD-3-Clause
// A TCP stream under a WebSocket that gathers frames: as long as it is corked, up to a bound, what is written
// waits; then all goes in one system call. Hundreds of small messages in a few milliseconds would else be as
// many calls. One thread; one write at a time. Beast's operations end here: each becomes a `Resume`, so that
// what is below is compiled once and not for each of them.
#pragma once
#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffer_traits.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <cstddef>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace fulmar::core::live {

/// What is to go on when bytes have come or gone, whatever its type.
class Resume {
 public:
  using error_code = boost::system::error_code;
  template <class Operation>
  static Resume of(Operation&& operation) {
    Resume resume;
    resume.step_ = std::make_unique<StepOf<std::decay_t<Operation>>>(std::forward<Operation>(operation));
    return resume;
  }
  void operator()(error_code ec, std::size_t size = 0) const { step_->go_on(ec, size); }

 private:
  struct Step {
    virtual ~Step() = default;
    virtual void go_on(error_code ec, std::size_t size) = 0;
  };
  template <class Operation>
  struct StepOf final : Step {
    explicit StepOf(Operation&& o) : operation(std::move(o)) {}
    void go_on(error_code ec, std::size_t size) override { operation(ec, size); }
    Operation operation;
  };
  std::unique_ptr<Step> step_;
};

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

  /// On: more will be written right after what is written next. The last write before a pause has to find it
  /// off.
  void cork(bool on) { corked_ = on; }

  template <class Buffers, class Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    std::array<boost::asio::mutable_buffer, 2> to;  // Beast's buffers are in two parts at most
    std::size_t n = 0;
    const auto end = boost::asio::buffer_sequence_end(buffers);
    for (auto part = boost::asio::buffer_sequence_begin(buffers); part != end && n < to.size(); ++part)
      to[n++] = *part;
    socket_.async_read_some(to, Resume::of(std::forward<Handler>(handler)));
  }

  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    const std::size_t size = boost::beast::buffer_bytes(buffers), before = held_.size();
    held_.resize(before + size);
    boost::asio::buffer_copy(boost::asio::buffer(held_.data() + before, size), buffers);
    go(size, Resume::of(std::forward<Handler>(handler)));
  }

  void write(std::string_view bytes, Resume resume) {
    held_.insert(held_.end(), bytes.begin(), bytes.end());
    go(bytes.size(), std::move(resume));
  }

  template <class Handler>
  friend void async_teardown(boost::beast::role_type role, Corked& corked, Handler&& handler) {
    using boost::beast::websocket::async_teardown;
    async_teardown(role, corked.socket_,
                   Resume::of([done = std::forward<Handler>(handler)](error_code ec, std::size_t) mutable {
                     done(ec);
                   }));
  }
  friend void beast_close_socket(Corked& corked) { corked.close(); }

 private:
  void go(std::size_t size, Resume resume) {
    if (corked_ && held_.size() < most_held)
      return boost::asio::post(get_executor(), [size, resume = std::move(resume)] { resume({}, size); });
    going_.swap(held_);
    held_.clear();
    boost::asio::async_write(
        socket_, boost::asio::buffer(going_),
        [size, resume = std::move(resume)](error_code ec, std::size_t) { resume(ec, ec ? 0 : size); });
  }

  static constexpr std::size_t most_held = 64u << 10;
  Socket socket_;
  std::vector<char> held_, going_;
  bool corked_ = false;
};

}  // namespace fulmar::core::live
