#include "frontend/host_mathematics.hpp"

#include <llvm/ADT/StringMap.h>

#include <cmath>
#include <variant>

namespace epiline::frontend {

namespace {

template <class T>
using unary = T (*)(T);
template <class T>
using binary = T (*)(T, T);
template <class T>
using scaling = T (*)(T, int);

using host_function = std::variant<unary<float>, unary<double>, binary<float>, binary<double>, scaling<float>,
                                   scaling<double>, long (*)(float), long (*)(double)>;

const llvm::StringMap<host_function>& host_functions() {
  static const llvm::StringMap<host_function> functions = [] {
    llvm::StringMap<host_function> all;
#define EPILINE_UNARY(name)            \
  all[#name] = unary<double>(&::name); \
  all[#name "f"] = unary<float>(&::name##f);
#define EPILINE_BINARY(name)            \
  all[#name] = binary<double>(&::name); \
  all[#name "f"] = binary<float>(&::name##f);
    EPILINE_UNARY(sin)
    EPILINE_UNARY(cos)
    EPILINE_UNARY(tan)
    EPILINE_UNARY(asin)
    EPILINE_UNARY(acos)
    EPILINE_UNARY(atan)
    EPILINE_UNARY(sinh)
    EPILINE_UNARY(cosh)
    EPILINE_UNARY(tanh)
    EPILINE_UNARY(asinh)
    EPILINE_UNARY(acosh)
    EPILINE_UNARY(atanh)
    EPILINE_UNARY(exp)
    EPILINE_UNARY(exp2)
    EPILINE_UNARY(expm1)
    EPILINE_UNARY(log)
    EPILINE_UNARY(log2)
    EPILINE_UNARY(log10)
    EPILINE_UNARY(log1p)
    EPILINE_UNARY(sqrt)
    EPILINE_UNARY(cbrt)
    EPILINE_UNARY(erf)
    EPILINE_UNARY(erfc)
    EPILINE_UNARY(tgamma)
    EPILINE_UNARY(lgamma)
    EPILINE_UNARY(fabs)
    EPILINE_UNARY(floor)
    EPILINE_UNARY(ceil)
    EPILINE_UNARY(trunc)
    EPILINE_UNARY(round)
    EPILINE_UNARY(rint)
    EPILINE_UNARY(nearbyint)
    EPILINE_BINARY(pow)
    EPILINE_BINARY(atan2)
    EPILINE_BINARY(hypot)
    EPILINE_BINARY(fmod)
    EPILINE_BINARY(remainder)
    EPILINE_BINARY(fmin)
    EPILINE_BINARY(fmax)
    EPILINE_BINARY(fdim)
    EPILINE_BINARY(copysign)
#undef EPILINE_UNARY
#undef EPILINE_BINARY
    all["ldexp"] = scaling<double>(&::ldexp);
    all["ldexpf"] = scaling<float>(&::ldexpf);
    all["scalbn"] = scaling<double>(&::scalbn);
    all["scalbnf"] = scaling<float>(&::scalbnf);
    for (const char* name : {"lround", "llround"}) {  // a long and a long long are the same here
      all[name] = static_cast<long (*)(double)>(&::lround);
      all[std::string(name) + "f"] = static_cast<long (*)(float)>(&::lroundf);
    }
    for (const char* name : {"lrint", "llrint"}) {
      all[name] = static_cast<long (*)(double)>(&::lrint);
      all[std::string(name) + "f"] = static_cast<long (*)(float)>(&::lrintf);
    }
    return all;
  }();
  return functions;
}

template <class T>
bool take(const llvm::Constant* constant, T& value) {
  if constexpr (std::is_same_v<T, int>) {
    const auto* number = llvm::dyn_cast<llvm::ConstantInt>(constant);
    if (number == nullptr) return false;
    value = static_cast<int>(number->getSExtValue());
    return true;
  } else {
    const auto* number = llvm::dyn_cast<llvm::ConstantFP>(constant);
    if (number == nullptr ||
        !(std::is_same_v<T, float> ? number->getType()->isFloatTy() : number->getType()->isDoubleTy()))
      return false;
    if constexpr (std::is_same_v<T, float>) {
      value = number->getValueAPF().convertToFloat();
    } else {
      value = number->getValueAPF().convertToDouble();
    }
    return true;
  }
}

llvm::Constant* give(float value, llvm::Type* type) {
  return type->isFloatTy() ? llvm::ConstantFP::get(type->getContext(), llvm::APFloat(value)) : nullptr;
}
llvm::Constant* give(double value, llvm::Type* type) {
  return type->isDoubleTy() ? llvm::ConstantFP::get(type->getContext(), llvm::APFloat(value)) : nullptr;
}
llvm::Constant* give(long value, llvm::Type* type) {
  return type->isIntegerTy(64) ? llvm::ConstantInt::getSigned(type, value) : nullptr;
}

template <class R, class A>
llvm::Constant* call(R (*function)(A), llvm::Type* result, llvm::ArrayRef<llvm::Constant*> arguments) {
  A value{};
  if (arguments.size() != 1 || !take(arguments[0], value)) return nullptr;
  return give(function(value), result);
}

template <class R, class A, class B>
llvm::Constant* call(R (*function)(A, B), llvm::Type* result, llvm::ArrayRef<llvm::Constant*> arguments) {
  A first{};
  B second{};
  if (arguments.size() != 2 || !take(arguments[0], first) || !take(arguments[1], second)) return nullptr;
  return give(function(first, second), result);
}

}  // namespace

bool is_host_mathematics(llvm::StringRef name) { return host_functions().contains(name); }

llvm::Constant* call_host_mathematics(llvm::StringRef name, llvm::Type* result,
                                      llvm::ArrayRef<llvm::Constant*> arguments) {
  const auto found = host_functions().find(name);
  if (found == host_functions().end()) return nullptr;
  return std::visit([&](auto function) { return call(function, result, arguments); }, found->second);
}

}  // namespace epiline::frontend
