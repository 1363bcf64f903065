#pragma once

namespace ifov {

/// One visitor of several lambdas, one for each member of a variant: std::visit does not compile where one is missing.
template <class... Lambdas>
struct Overloaded : Lambdas... {
  using Lambdas::operator()...;
};
template <class... Lambdas>
Overloaded(Lambdas...) -> Overloaded<Lambdas...>;

}  // namespace ifov
