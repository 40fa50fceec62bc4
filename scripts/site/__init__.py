"""The site: parts as WebAssembly, sessions, meanings of bytes, pages (`make site`, `make test-web`)."""
