import { compare } from "./hashes.mjs";

compare("double");
