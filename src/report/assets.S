/* The files that the report page is made of. The build passes their paths: CINCH_CHART_JS, ... */

.macro asset name, file
  .global cinch_asset_\name
  .global cinch_asset_\name\()_end
cinch_asset_\name:
  .incbin "\file"
cinch_asset_\name\()_end:
  .byte 0
.endm

  .section .rodata
  asset chart_js, CINCH_CHART_JS
  asset three_js, CINCH_THREE_JS
  asset page_css, CINCH_PAGE_CSS
  asset page_js, CINCH_PAGE_JS

  .section .note.GNU-stack, "", %progbits
