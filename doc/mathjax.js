// SPDX-License-Identifier: LGPL-2.1-or-later
// Loads the MathJax that conf.py copies beside this file, so that formulas show without a network.
const script = document.createElement("script");
script.src = new URL("mathjax/MathJax.js?config=TeX-AMS_CHTML", document.currentScript.src).href;
document.head.append(script);
