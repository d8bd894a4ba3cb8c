// A shared library, but no plugin: it exports no descriptor.
extern "C" __attribute__((visibility("default"))) int something_else() {
  return 0;
}
