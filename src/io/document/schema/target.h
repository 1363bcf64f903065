#pragma once

#include <concepts>
#include <functional>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

namespace ifov::io {

/// Where a row of a table puts its value and finds it again: a pointer to a member (of the value's type, an optional or a
/// variant of it), or one of the following.

/// `set(T&, V)`; `get(const T&)` gives the value, an optional of it, or a pointer that may be null.
template <class Set, class Get>
struct Via {
  Set set;
  Get get;
};
template <class Set, class Get>
Via<Set, Get> via(Set set, Get get) {
  return {std::move(set), std::move(get)};
}

/// For keys that say nothing of the record, or what another key is written for.
template <class Set>
struct OnlyRead {
  Set set;
};
template <class Set>
OnlyRead<Set> only_read(Set set) {
  return {std::move(set)};
}

/// A value further inside: the members on the way to it. What may be absent on the way is made when a value is stored.
template <class... Members>
struct Path {
  std::tuple<Members...> members;
};
template <class... Members>
Path<Members...> path(Members... members) {
  return {{members...}};
}

namespace target {

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class V, class T>
inline constexpr bool is_alternative = false;
template <class V, class... A>
inline constexpr bool is_alternative<V, std::variant<A...>> = (std::same_as<V, A> || ...);

template <class T, class First, class... Rest>
auto& reach(T& from, First first, Rest... rest) {
  auto& next = from.*first;
  if constexpr (sizeof...(Rest) == 0)
    return next;
  else if constexpr (is_optional<std::remove_reference_t<decltype(next)>>)
    // Made here, since clang 14 takes a class within a class for one that cannot be made of nothing.
    return reach(next ? *next : next.emplace(typename std::remove_reference_t<decltype(next)>::value_type{}),
                 rest...);
  else
    return reach(next, rest...);
}

template <class T, class First, class... Rest>
const auto* find(const T& from, First first, Rest... rest) {
  const auto& next = from.*first;
  if constexpr (sizeof...(Rest) == 0) {
    return &next;
  } else if constexpr (is_optional<std::remove_cvref_t<decltype(next)>>) {
    using Found = decltype(find(*next, rest...));
    return next ? find(*next, rest...) : Found(nullptr);
  } else {
    return find(next, rest...);
  }
}

/// A member as a V, where it holds one.
template <class V, class Member>
std::optional<V> as(const Member& member) {
  if constexpr (std::same_as<Member, V> || std::same_as<Member, std::optional<V>>) {
    return member;
  } else if constexpr (is_alternative<V, Member>) {
    const V* held = std::get_if<V>(&member);
    return held != nullptr ? std::optional<V>(*held) : std::nullopt;
  } else if constexpr (std::is_pointer_v<Member>) {
    return member != nullptr ? std::optional<V>(*member) : std::nullopt;
  } else {
    return std::optional<V>(member);
  }
}

}  // namespace target

template <class T, class M, class V>
void store(T& record, M T::*member, V value) {
  record.*member = std::move(value);
}
template <class V, class T, class M>
std::optional<V> load(const T& record, M T::*member) {
  return target::as<V>(record.*member);
}

template <class T, class Set, class Get, class V>
void store(T& record, const Via<Set, Get>& via, V value) {
  via.set(record, std::move(value));
}
template <class V, class T, class Set, class Get>
std::optional<V> load(const T& record, const Via<Set, Get>& via) {
  return target::as<V>(via.get(record));
}

template <class T, class Set, class V>
void store(T& record, const OnlyRead<Set>& only, V value) {
  only.set(record, std::move(value));
}
template <class V, class T, class Set>
std::optional<V> load(const T&, const OnlyRead<Set>&) {
  return std::nullopt;
}

template <class T, class... Members, class V>
void store(T& record, const Path<Members...>& path, V value) {
  std::apply(
      [&](auto... members) -> auto& { return target::reach(record, members...); }, path.members) =
      std::move(value);
}
template <class V, class T, class... Members>
std::optional<V> load(const T& record, const Path<Members...>& path) {
  const auto* found =
      std::apply([&](auto... members) { return target::find(record, members...); }, path.members);
  return found != nullptr ? target::as<V>(*found) : std::nullopt;
}

}  // namespace ifov::io
