// Loaded before OpenBLAS, it says what OpenBLAS says on a processor that it does not know.
extern "C" char* openblas_get_corename() {
  static char name[] = "Prescott";
  return name;
}
