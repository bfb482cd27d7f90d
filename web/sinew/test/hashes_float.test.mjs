import { compare } from "./hashes.mjs";

compare("float");
