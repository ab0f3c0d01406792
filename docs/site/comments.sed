# A comment on lines of its own is about what follows; the first one names the file; one behind code is about that code.
s|^// ([a-z_/]+\.hp*): |/// \\file\n/// |
s|^( *)//( .*)?$|\1///\2|
s|^( *[^/ ].*[;,{}] +)// |\1///< |
s|^(#define .* )// |\1///< |
