/* SPDX-License-Identifier: MIT */
// describe LIBRARY: loads a plugin library as a host does, and prints the id of each of its plugins.
#include <dlfcn.h>
#include <dmrp/dmrp.h>
#include <stdio.h>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  void* library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
  const dmrp_entry* entry = library ? (const dmrp_entry*)dlsym(library, DMRP_ENTRY_SYMBOL) : NULL;
  if (!entry) {
    fprintf(stderr, "%s\n", dlerror());
    return 1;
  }
  if (entry->struct_size < sizeof(dmrp_entry) || entry->abi_draft != DMRP_ABI_DRAFT) {
    fprintf(stderr, "%s: another draft of the contract\n", argv[1]);
    return 1;
  }
  for (uint32_t i = 0; i < entry->plugin_count(entry); ++i) puts(entry->descriptor(entry, i)->id);
  return 0;
}
