#include "tests/fuzz/hdf5_types.hpp"

#include <array>

namespace barchan::fuzz {

using hdf5::Handle;

namespace {

Handle text(std::size_t size) {
  Handle string(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(string.get(), size);
  return string;
}

}  // namespace

Handle any_type(Tape& tape) {
  const auto copy = [](hid_t of) { return Handle(H5Tcopy(of), H5Tclose); };
  switch (tape.pick(20)) {
    case 0:
      return copy(H5T_IEEE_F64LE);
    case 1:
      return copy(H5T_STD_I64LE);
    case 2:
      return copy(H5T_IEEE_F32LE);
    case 3:
      return copy(H5T_IEEE_F64BE);
    case 4:
      return copy(H5T_STD_U64LE);
    case 5:
      return copy(H5T_STD_I8LE);
    case 6:
      return copy(H5T_STD_I64BE);
    case 7:
      return copy(H5T_NATIVE_LDOUBLE);
    case 8:
      return text(H5T_VARIABLE);
    case 9:
      return text(1 + tape.byte());
    case 10:
      return text(std::size_t{1} << tape.pick(28));
    case 11:
      return {H5Tcreate(H5T_OPAQUE, 1 + tape.byte()), H5Tclose};
    case 12: {
      Handle pair(H5Tcreate(H5T_COMPOUND, 16), H5Tclose);
      H5Tinsert(pair.get(), "a", 0, H5T_IEEE_F64LE);
      H5Tinsert(pair.get(), "b", 8, H5T_STD_I64LE);
      return pair;
    }
    case 13: {
      const std::array<hsize_t, 1> three{tape.extent() % 100000 + 1};
      return {H5Tarray_create2(H5T_IEEE_F64LE, 1, three.data()), H5Tclose};
    }
    case 14:
      return {H5Tvlen_create(H5T_IEEE_F64LE), H5Tclose};
    case 15:
      return copy(H5T_STD_REF_OBJ);
    case 16: {
      Handle names_of_numbers(H5Tenum_create(H5T_STD_I64LE), H5Tclose);
      const std::int64_t one = 1;
      H5Tenum_insert(names_of_numbers.get(), "one", &one);
      return names_of_numbers;
    }
    case 17:
      return copy(H5T_STD_B64LE);
    case 18: {  // a real number of odd size
      Handle real(H5Tcopy(H5T_IEEE_F64LE), H5Tclose);
      H5Tset_precision(real.get(), 40);
      H5Tset_fields(real.get(), 39, 28, 11, 0, 28);
      H5Tset_size(real.get(), 5);
      return real;
    }
    default:
      return copy(H5T_UNIX_D64LE);
  }
}

}  // namespace barchan::fuzz
