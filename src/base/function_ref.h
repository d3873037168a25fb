#pragma once

#include <concepts>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>

namespace quasimc {

template <typename Signature>
class FunctionRef;

/// A non-owning reference to a callable, which must outlive the call; it does not allocate (like
/// std::function_ref of C++26).
template <typename Result, typename... Arguments>
class FunctionRef<Result(Arguments...)> {
  public:
    template <typename Callable>
    requires(
        std::is_invocable_r_v<Result, Callable&, Arguments...> &&
        !std::same_as<std::remove_cvref_t<Callable>, FunctionRef>)
        // NOLINTNEXTLINE(bugprone-forwarding-reference-overload,google-explicit-constructor)
        FunctionRef(Callable&& callable)
        : callable_(const_cast<void*>(static_cast<const void*>(std::addressof(callable)))),
          call_([](void* at, Arguments... arguments) -> Result {
              auto& function = *static_cast<std::remove_reference_t<Callable>*>(at);
              return std::invoke(function, std::forward<Arguments>(arguments)...);
          }) {}

    Result operator()(Arguments... arguments) const {
        return call_(callable_, std::forward<Arguments>(arguments)...);
    }

  private:
    void* callable_;
    Result (*call_)(void* at, Arguments... arguments);
};

}  // namespace quasimc
