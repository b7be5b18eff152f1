# Builds for 64-bit Arm beside an x86-64 Debian: the compiler crosses over, libraries come from Debian's arm64, headers
# and CMake's files, which do not differ, from the packages that are here.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64)

# CMake's search asks the compiler wrapper of this machine, and two libhdf5-dev exclude each other
set(HDF5_C_LIBRARIES /usr/lib/aarch64-linux-gnu/libhdf5_serial.so.103)
set(HDF5_C_INCLUDE_DIRS /usr/include/hdf5/serial)
set(tomlplusplus_DIR /usr/lib/x86_64-linux-gnu/cmake/tomlplusplus)
